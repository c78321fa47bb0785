#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cpslam/rgbd_frame.h"
#include "cpslam/settings.h"
#include "detect/people.h"
#include "features/frame_features.h"
#include "util/stage_timer.h"

namespace cpslam {

/// From images to the features that are not on people: extraction and the people filter, hand in hand. One
/// thread.
class StaticFeatures {
 public:
  /// people and timer must outlive this.
  StaticFeatures(const Settings& settings, People& people, StageTimer& timer);

  /// Between People::begin() and end() of the same frame. depth_from_colour: how the camera moved from the
  /// exposure of the colour image to that of the depth image.
  [[nodiscard]] std::shared_ptr<const FrameFeatures> extract(const RgbdFrame& frame,
                                                             const SE3& depth_from_colour);

  /// Adds the keypoints of the last frame, kept and removed, to what is drawn of it. tracked: parallel to the
  /// kept ones, whether one is on the map.
  void show(const std::vector<bool>& tracked, FrameView& view) const;

 private:
  People& people_;
  StageTimer& timer_;
  FrameFeaturesBuilder builder_;
  KeypointCandidates* candidates_ = nullptr;  // of the last frame; builder_ owns them
  std::vector<std::uint8_t> kept_;            // parallel to them
};

}  // namespace cpslam
