#include "diagnosis/stamps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/percentile.h"
#include "io/association.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr const char* kCheck = "frame rate";
constexpr const char* kPairs = "colour-depth pairs";

void add_order(const std::string& name, const Rhythm& rhythm, Findings& findings) {
  if (rhythm.n_repeated + rhythm.n_backward == 0) return;
  findings.push_back({Level::kError,
                      kCheck,
                      name + format_text(": %zu stamps repeat the one before, %zu go back", rhythm.n_repeated,
                                         rhythm.n_backward),
                      "sort the list by time and remove repeats: rgbd_tum refuses it as it is",
                      {{"repeated", static_cast<double>(rhythm.n_repeated)},
                       {"backward", static_cast<double>(rhythm.n_backward)}}});
}

void judge_gaps(const Rhythm& rhythm, Finding& finding) {
  // A camera turned at 60 degrees a second is on something else after so long.
  constexpr double kLong_s = 0.35, kVeryLong_s = 1.0;
  if (rhythm.longest_s > kVeryLong_s && rhythm.longest_s > 5.0 * rhythm.interval_s) {
    finding.level = Level::kError;
    finding.advice =
        "tracking may be lost at the gap: cut the sequence there (--start, --max-frames), or record again";
  } else if (rhythm.missing_share > 0.15 ||
             (rhythm.longest_s > kLong_s && rhythm.longest_s > 3.0 * rhythm.interval_s)) {
    finding.level = Level::kWarning;
    finding.advice =
        "the recorder dropped pictures: a faster disk, less load, or a USB port of its own for the camera";
  } else if (rhythm.n_gaps > 0) {
    finding.level = Level::kNote;
    finding.advice = "single pictures were dropped; quick turns suffer most";
  }
}

Finding rate(const std::string& name, const Rhythm& rhythm) {
  Finding finding{Level::kOk,
                  kCheck,
                  name + format_text(": %.1f a second (median), longest gap %.3f s", 1.0 / rhythm.interval_s,
                                     rhythm.longest_s),
                  "",
                  {{"rate_hz", 1.0 / rhythm.interval_s},
                   {"longest_gap_s", rhythm.longest_s},
                   {"longest_gap_at_s", rhythm.longest_at_s},
                   {"gaps", static_cast<double>(rhythm.n_gaps)},
                   {"missing_share", rhythm.missing_share}}};
  if (rhythm.n_gaps > 0)
    finding.what += format_text(" at %.3f; %zu gaps, %.1f %% missing", rhythm.longest_at_s, rhythm.n_gaps,
                                100.0 * rhythm.missing_share);
  judge_gaps(rhythm, finding);
  constexpr double kSlow_s = 1.0 / 12.0;
  if (finding.level < Level::kWarning && rhythm.interval_s > kSlow_s) {
    finding.level = Level::kWarning;
    finding.advice = "slow for a camera in the hand: move gently, or record at 30 a second";
  }
  return finding;
}

}  // namespace

Rhythm find_rhythm(std::span<const double> stamps_s) {
  Rhythm rhythm;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps_s.size(); ++i) {
    const double interval = stamps_s[i] - stamps_s[i - 1];
    if (interval == 0.0) ++rhythm.n_repeated;
    if (interval < 0.0) ++rhythm.n_backward;
    if (!(interval > 0.0)) continue;
    intervals.push_back(interval);
    if (interval <= rhythm.longest_s) continue;
    rhythm.longest_s = interval;
    rhythm.longest_at_s = stamps_s[i - 1];
  }
  if (intervals.empty()) return rhythm;
  rhythm.interval_s = percentile(intervals, 0.5);
  double missing = 0.0;
  for (const double interval : intervals) {
    if (interval <= 1.6 * rhythm.interval_s) continue;
    ++rhythm.n_gaps;
    missing += std::round(interval / rhythm.interval_s) - 1.0;
  }
  rhythm.missing_share = missing / (missing + static_cast<double>(intervals.size() + 1));
  return rhythm;
}

Findings check_rhythm(const std::string& name, std::span<const double> stamps_s,
                      std::optional<double> nominal_fps) {
  Findings findings;
  const Rhythm rhythm = find_rhythm(stamps_s);
  add_order(name, rhythm, findings);
  if (rhythm.interval_s == 0.0) return findings;
  findings.push_back(rate(name, rhythm));
  if (nominal_fps && std::abs(*nominal_fps * rhythm.interval_s - 1.0) > 0.2)
    findings.push_back({Level::kNote,
                        kCheck,
                        name + format_text(": SETTINGS say Camera.fps %g, the stamps %.1f", *nominal_fps,
                                           1.0 / rhythm.interval_s),
                        "correct Camera.fps: live runs pace by it",
                        {}});
  return findings;
}

Findings check_pairs(std::span<const double> colour_s, std::span<const double> depth_s) {
  constexpr double kMaxDifference_s = 0.02;  // as rgbd_tum pairs them
  const auto pairs = associate_stamps(colour_s, depth_s, kMaxDifference_s);
  if (colour_s.empty() || depth_s.empty()) return {};
  if (pairs.empty())
    return {
        {Level::kError,
         kPairs,
         format_text("no colour picture has a depth picture within %.2f s: the lists begin at %.3f and %.3f",
                     kMaxDifference_s, colour_s.front(), depth_s.front()),
         "both lists need stamps of one clock",
         {}}};
  std::vector<double> differences;
  for (const auto& [i, j] : pairs) differences.push_back(depth_s[j] - colour_s[i]);
  const double alone = 1.0 - static_cast<double>(pairs.size()) / static_cast<double>(colour_s.size());
  const double median_ms = 1000.0 * percentile(differences, 0.5);
  Finding finding{
      Level::kOk,
      kPairs,
      format_text("%zu pairs, depth stamped %.1f ms after colour (median), %.1f %% of colour alone",
                  pairs.size(), median_ms, 100.0 * alone),
      "",
      {{"pairs", static_cast<double>(pairs.size())},
       {"stamp_difference_s", 0.001 * median_ms},
       {"unpaired_share", alone}}};
  if (alone > 0.5) {
    finding.level = Level::kError;
    finding.advice = "bring the two streams to one clock and rate: only pairs are tracked";
  } else if (alone > 0.15) {
    finding.level = Level::kWarning;
    finding.advice = "pictures without partner are lost to SLAM: record both streams at one rate, in sync";
  }
  return {finding};
}

}  // namespace cpslam::diagnosis
