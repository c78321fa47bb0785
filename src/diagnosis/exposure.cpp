#include "diagnosis/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>

#include "diagnosis/percentile.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {

void ExposureCheck::add(const ExaminedFrame& frame) {
  constexpr double kSaturated = 250.0;  // grey level
  const auto n_saturated = static_cast<double>(cv::countNonZero(frame.grey >= kSaturated));
  samples_.push_back(
      {frame.time_s, cv::mean(frame.grey)[0], n_saturated / static_cast<double>(frame.grey.total())});
}

Finding ExposureCheck::level_finding() const {
  constexpr double kBlack = 12.0, kDark = 40.0;
  constexpr double kBurntShare = 0.2;
  std::vector<double> means, saturated;
  for (const Sample& sample : samples_) {
    means.push_back(sample.mean);
    saturated.push_back(sample.saturated_share);
  }
  const double mean = percentile(means, 0.5), burnt = percentile(saturated, 0.5);
  const auto black =
      static_cast<double>(std::count_if(means.begin(), means.end(), [](double m) { return m < kBlack; }));
  const double black_share = black / static_cast<double>(means.size());
  Finding finding{Level::kOk,
                  "exposure",
                  format_text("mean grey level %.0f of 255, %.1f %% of the pixels burnt out (medians)", mean,
                              100.0 * burnt),
                  "",
                  {{"mean_grey", mean}, {"saturated_share", burnt}, {"black_frames_share", black_share}}};
  if (mean < kBlack) {
    finding.level = Level::kError;
    finding.what += ": black";
    finding.advice = "is the lens covered, or the light off? Nothing can be tracked in black pictures";
  } else if (black_share > 0.02) {
    finding.level = Level::kWarning;
    finding.what += format_text(", %.0f %% of the frames black", 100.0 * black_share);
    finding.advice = "leave the black pictures out: tracking is lost in each stretch of them";
  } else if (mean < kDark) {
    finding.level = Level::kWarning;
    finding.what += ": dark";
    finding.advice =
        "more light, or a longer exposure while the camera moves slowly; ORBextractor.minThFAST 4 helps";
  } else if (burnt > kBurntShare) {
    finding.level = Level::kWarning;
    finding.what += ": over-exposed";
    finding.advice =
        "shorten the exposure, or switch auto-exposure on and keep windows and lamps out of view";
  }
  return finding;
}

Finding ExposureCheck::change_finding() const {
  constexpr double kJump = 1.25;  // ratio of the brightness of two frames in a row
  constexpr double kConsecutive_s = 0.2;
  std::size_t n_compared = 0, n_jumps = 0;
  double largest = 1.0;
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    if (samples_[i].time_s - samples_[i - 1].time_s > kConsecutive_s) continue;
    ++n_compared;
    const double a = std::max(1.0, samples_[i - 1].mean), b = std::max(1.0, samples_[i].mean);
    const double ratio = std::max(a / b, b / a);
    largest = std::max(largest, ratio);
    if (ratio > kJump) ++n_jumps;
  }
  Finding finding{Level::kOk,
                  "exposure",
                  format_text("brightness changes by a factor of at most %.2f from frame to frame", largest),
                  "",
                  {{"largest_change", largest}, {"jumps", static_cast<double>(n_jumps)}}};
  if (n_jumps == 0) return finding;
  finding.level =
      static_cast<double>(n_jumps) > 0.02 * static_cast<double>(n_compared) ? Level::kWarning : Level::kNote;
  finding.what += format_text(", by more than %.2f in %zu places", kJump, n_jumps);
  finding.advice = "fix exposure and white balance, or turn more slowly towards windows and lamps";
  return finding;
}

Findings ExposureCheck::findings() const {
  if (samples_.empty()) return {};
  return {level_finding(), change_finding()};
}

}  // namespace cpslam::diagnosis
