#include "diagnosis/alignment.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "diagnosis/edge_comparison.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr double kLargestWidth = 640.0;     // px; of larger pictures a smaller copy is looked at
constexpr std::size_t kMostFrames = 400;    // kept, some 7 MB
constexpr std::size_t kGrowthEvery = 10;    // frames
constexpr std::size_t kFewestEdges = 2000;  // to say anything
constexpr double kLeastContrast = 4.0;
constexpr const char* kRegistration = "registration";

Finding unknown_registration(std::size_t n_edges, std::size_t n_frames) {
  constexpr std::size_t kManyEdges = 500;  // a frame
  if (n_edges > kManyEdges * n_frames) {
    return {Level::kWarning,
            kRegistration,
            "edges of depth and of colour meet at no shift: depth is hardly registered to colour",
            "switch depth-to-colour registration (alignment) on when recording",
            {}};
  }
  return {Level::kNote,
          kRegistration,
          "cannot be told: too few edges of depth",
          "to have it measured, show furniture in front of a wall, 1-3 m away",
          {}};
}

Finding grown_registration(const DepthGrowth& growth) {
  return {Level::kError,
          kRegistration,
          format_text("depth is about %.0f %% too %s for colour: it is not registered",
                      100.0 * std::abs(growth.growth), growth.growth > 0.0 ? "small" : "large"),
          "switch depth-to-colour registration (alignment) on when recording; lenses differ, a shift is not "
          "enough",
          {{"growth", growth.growth}, {"contrast", growth.contrast}}};
}

Finding shifted_registration(const AgreementPeak& peak, double width_px) {
  constexpr double kSlightShare = 0.006, kSevereShare = 0.016;  // of the width: 4 and 10 px of 640
  const double right_px = -peak.at_px.x, down_px = -peak.at_px.y;
  const double size_px = std::hypot(right_px, down_px);
  Finding finding{
      Level::kOk,
      kRegistration,
      format_text("depth lies %.1f px %s and %.1f px %s its colour", std::abs(right_px),
                  right_px >= 0.0 ? "right" : "left", std::abs(down_px), down_px >= 0.0 ? "below" : "above"),
      "",
      {{"right_px", right_px}, {"down_px", down_px}, {"contrast", peak.contrast}}};
  if (size_px < kSlightShare * width_px) return finding;
  finding.level = size_px < kSevereShare * width_px ? Level::kWarning : Level::kError;
  finding.advice =
      "switch registration on when recording; if it is on, calibrate the two cameras to each other";
  return finding;
}

Finding time_offset(const std::optional<DepthDelay>& delay) {
  constexpr double kSlight_s = 0.015, kSevere_s = 0.06, kUnsure_s = 0.01;
  const char* const check = "time offset";
  if (!delay || delay->sigma_s > kUnsure_s || delay->with_delay.contrast < kLeastContrast) {
    return {Level::kNote,
            check,
            "cannot be told from these pictures: too little motion, or too few edges",
            "to have it measured, turn the camera briskly to and fro in a furnished room",
            {}};
  }
  const double off_s = std::abs(delay->delay_s);
  const bool late = delay->delay_s >= 0.0;
  Finding finding{Level::kOk,
                  check,
                  format_text("depth was taken %.0f ms %s than its stamps say, by colour's (+- %.0f ms)",
                              1000.0 * off_s, late ? "earlier" : "later", 1000.0 * delay->sigma_s),
                  "",
                  {{"delay_s", delay->delay_s}, {"sigma_s", delay->sigma_s}}};
  const double sure_s = off_s - 2.0 * delay->sigma_s;
  if (sure_s < kSlight_s) return finding;
  finding.level = sure_s < kSevere_s ? Level::kWarning : Level::kError;
  finding.advice = format_text("switch frame sync on, or %s %.3f s %s every stamp of depth.txt",
                               late ? "subtract" : "add", off_s, late ? "from" : "to");
  return finding;
}

}  // namespace

void AlignmentCheck::keep(FrameAgreement frame) {
  if (n_frames_++ % n_skip_ != 0 || frame.map.n_edges() == 0) return;
  if (frames_.size() == kMostFrames) {
    for (std::size_t i = 0; 2 * i < frames_.size(); ++i) std::swap(frames_[i], frames_[2 * i]);
    frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(kMostFrames / 2), frames_.end());
    n_skip_ *= 2;
  }
  frames_.push_back(std::move(frame));
}

void AlignmentCheck::add(const ExaminedFrame& frame) {
  width_px_ = frame.grey.cols;
  scale_ = std::min(1.0, kLargestWidth / width_px_);
  cv::Mat grey, readings;
  cv::resize(frame.grey, grey, {}, scale_, scale_, cv::INTER_AREA);
  cv::resize(frame.readings, readings, grey.size(), 0.0, 0.0, cv::INTER_NEAREST);
  motion_.add(frame.time_s, grey);
  if (n_frames_ % kGrowthEvery == 0) growth_.add(grey, readings);
  AgreementMap map = EdgeComparison::make_map(grey.size());
  if (!whole_) whole_ = map;
  EdgeComparison(grey, readings).add_to(map);
  whole_->add(map);
  map.centre();
  keep({frame.time_s, frame.depth_time_s, std::move(map)});
}

Finding AlignmentCheck::registration(const std::optional<DepthDelay>& delay) const {
  constexpr double kLeastGrowth = 0.015, kLeastGain = 1.15;
  const std::optional<DepthGrowth> growth = growth_.best();
  if (growth && std::abs(growth->growth) > kLeastGrowth && growth->gain > kLeastGain &&
      growth->contrast > kLeastContrast)
    return grown_registration(*growth);
  std::optional<AgreementPeak> peak = whole_->peak();
  // A delay in a moving camera moves depth as well.
  if (delay && (!peak || delay->with_delay.contrast > peak->contrast)) peak = delay->with_delay;
  if (whole_->n_edges() < kFewestEdges || !peak || peak->contrast < kLeastContrast)
    return unknown_registration(whole_->n_edges(), n_frames_);
  peak->at_px /= scale_;
  return shifted_registration(*peak, width_px_);
}

Findings AlignmentCheck::findings() const {
  if (!whole_) return {};
  const std::optional<DepthDelay> delay = find_depth_delay(frames_, motion_);
  return {registration(delay), time_offset(delay)};
}

}  // namespace cpslam::diagnosis
