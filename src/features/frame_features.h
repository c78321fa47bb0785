#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "camera/pinhole_camera.h"
#include "cpslam/settings.h"
#include "features/descriptor.h"
#include "features/keypoint.h"
#include "features/keypoint_depth.h"
#include "features/keypoint_grid.h"
#include "features/orb_extractor.h"
#include "geometry/se3.h"

namespace cpslam {

/// What a frame's images say, computed once and then shared, unchanged, between the frame and its keyframe.
/// The vectors are parallel. A const FrameFeatures may be read from several threads.
struct FrameFeatures {
  std::vector<Keypoint> keypoints;  ///< undistorted px
  std::vector<Descriptor> descriptors;
  std::vector<float> depth_m;  ///< along z; 0 where there is none
  std::vector<float>
      disparity_px;  ///< bf / depth: between here and a camera bf / fx to the right; 0 without depth
  std::vector<float> depth_sigma_m;  ///< standard deviation of depth_m; 0 without depth
  KeypointGrid grid;                 ///< over keypoints

  [[nodiscard]] int size() const { return static_cast<int>(keypoints.size()); }
};

/// Fills in what follows from keypoints and depths: the disparities and the grid.
void derive(FrameFeatures& features, const PinholeCamera& camera);

/// Keypoints of a frame before anybody said which of them to keep. The vectors are parallel.
struct KeypointCandidates {
  OrbFeatures orb;                    ///< distorted px: where to look in the images
  std::vector<Keypoint> undistorted;  ///< the same keypoints
  std::vector<DepthReading> depth;    ///< at the colour image's instant

  [[nodiscard]] int size() const { return static_cast<int>(undistorted.size()); }
};

/// Makes FrameFeatures of images, in two steps so that a filter can work in between: extract() (and extend(),
/// when the filter leaves too few), then finish(). Keeps working memory between calls: one builder per
/// thread.
class FrameFeaturesBuilder {
 public:
  FrameFeaturesBuilder(const CameraSettings& camera, const OrbSettings& orb);

  /// grey: 8-bit, of the camera's size. depth: registered to it, of the same size, CV_16UC1 or CV_32FC1 in
  /// units of DepthMapFactor; 0, negative and not finite mean no reading. Throws InputError on another type
  /// or size.
  /// depth_from_colour: how the camera moved from the exposure of the colour image to that of the depth
  /// image; the depths are brought back to the colour image's instant with it.
  /// The result is the builder's and lasts until the next call of extract() or build().
  KeypointCandidates& extract(const cv::Mat& grey, const cv::Mat& depth, const SE3& depth_from_colour = {},
                              const ExtractionPrior& prior = {});

  /// Appends up to `wanted` keypoints outside `excluded`, as OrbExtractor::extract_more does, to what
  /// extract() gave; the depth image must still be there, unchanged. Returns how many were added.
  int extend(KeypointCandidates& candidates, const cv::Mat& excluded, int wanted);

  /// The candidates for which `keep`, parallel to them, is not zero. Throws InputError on another length.
  [[nodiscard]] std::shared_ptr<const FrameFeatures> finish(const KeypointCandidates& candidates,
                                                            std::span<const std::uint8_t> keep) const;

  /// Both steps, keeping all.
  [[nodiscard]] std::shared_ptr<const FrameFeatures> build(const cv::Mat& grey, const cv::Mat& depth,
                                                           const SE3& depth_from_colour = {});

 private:
  void complete(KeypointCandidates& candidates) const;
  void add_keypoint(const KeypointCandidates& candidates, std::size_t i, FrameFeatures& features) const;
  [[nodiscard]] DepthReading read_depth(const Eigen::Vector2d& distorted_px) const;
  [[nodiscard]] DepthReading follow_motion(DepthReading reading, const Eigen::Vector2d& undistorted_px) const;

  PinholeCamera camera_;
  double metres_per_unit_;
  OrbExtractor extractor_;
  KeypointCandidates candidates_;
  cv::Mat depth_;  // of the frame in hand, shared with the caller
  SE3 depth_from_colour_;
};

}  // namespace cpslam
