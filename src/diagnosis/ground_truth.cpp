#include "diagnosis/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "diagnosis/stamps.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr const char* kCheck = "ground truth";

/// Share of the frames with a pose within 0.02 s, which is what counts in the ATE.
double covered_share(const std::vector<double>& sorted_s, std::span<const double> colour_s) {
  constexpr double kNear_s = 0.02;
  std::size_t n_covered = 0;
  for (const double time_s : colour_s) {
    const auto next = std::lower_bound(sorted_s.begin(), sorted_s.end(), time_s - kNear_s);
    if (next != sorted_s.end() && *next <= time_s + kNear_s) ++n_covered;
  }
  return static_cast<double>(n_covered) / static_cast<double>(colour_s.size());
}

/// Fastest motion between poses at most a second apart, m/s.
double top_speed(const Trajectory& truth) {
  double fastest = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const double passed_s = truth[i].time_s - truth[i - 1].time_s;
    if (passed_s < 1e-4 || passed_s > 1.0) continue;
    const auto& a = truth[i - 1].world_from_camera.translation_m;
    const auto& b = truth[i].world_from_camera.translation_m;
    fastest = std::max(fastest, std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / passed_s);
  }
  return fastest;
}

Finding coverage(double share, double rate_hz) {
  Finding finding{Level::kOk,
                  kCheck,
                  format_text("%.0f poses a second, %.1f %% of the frames have one", rate_hz, 100.0 * share),
                  "",
                  {{"rate_hz", rate_hz}, {"covered_share", share}}};
  if (share == 0.0) {
    finding.level = Level::kError;
    finding.advice = "its clock is not the pictures': an error against it means nothing";
  } else if (share < 0.8) {
    finding.level = Level::kWarning;
    finding.advice = "the ATE is over the covered frames alone: read it next to their number";
  }
  return finding;
}

}  // namespace

Findings check_ground_truth(const Trajectory& truth, std::span<const double> colour_s) {
  if (truth.empty())
    return {{Level::kWarning, kCheck, "groundtruth.txt holds no pose", "remove or replace it", {}}};
  if (colour_s.empty()) return {};
  std::vector<double> stamps;
  for (const StampedPose& pose : truth) stamps.push_back(pose.time_s);
  const Rhythm rhythm = find_rhythm(stamps);
  Findings findings;
  if (rhythm.n_backward > 0)
    findings.push_back({Level::kWarning,
                        kCheck,
                        format_text("%zu stamps go back", rhythm.n_backward),
                        "sort it by time",
                        {{"backward", static_cast<double>(rhythm.n_backward)}}});
  std::sort(stamps.begin(), stamps.end());
  findings.push_back(
      coverage(covered_share(stamps, colour_s), rhythm.interval_s > 0.0 ? 1.0 / rhythm.interval_s : 0.0));
  constexpr double kFast_m_s = 5.0;
  const double speed = top_speed(truth);
  if (speed > kFast_m_s)
    findings.push_back({Level::kWarning,
                        kCheck,
                        format_text("it jumps: up to %.1f m/s between two poses", speed),
                        "outliers of the tracking system: remove these poses",
                        {{"top_speed_m_s", speed}}});
  return findings;
}

}  // namespace cpslam::diagnosis
