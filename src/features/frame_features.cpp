#include "features/frame_features.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "cpslam/error.h"
#include "features/image_check.h"

namespace cpslam {

void derive(FrameFeatures& features, const PinholeCamera& camera) {
  features.disparity_px.clear();
  features.disparity_px.reserve(features.depth_m.size());
  const auto bf = static_cast<float>(camera.bf());
  for (const float depth_m : features.depth_m) {
    features.disparity_px.push_back(depth_m > 0.0F ? bf / depth_m : 0.0F);
  }
  features.grid = KeypointGrid(features.keypoints, camera.undistorted_bounds());
}

FrameFeaturesBuilder::FrameFeaturesBuilder(const CameraSettings& camera, const OrbSettings& orb)
    : camera_(camera), metres_per_unit_(1.0 / camera.depth_map_factor), extractor_(orb) {}

KeypointCandidates& FrameFeaturesBuilder::extract(const cv::Mat& grey, const cv::Mat& depth,
                                                  const SE3& depth_from_colour,
                                                  const ExtractionPrior& prior) {
  check_images(grey, depth, {camera_.width(), camera_.height()});
  extractor_.extract(grey, candidates_.orb, prior);
  depth_ = depth;
  depth_from_colour_ = depth_from_colour;
  candidates_.undistorted.clear();
  candidates_.depth.clear();
  complete(candidates_);
  return candidates_;
}

int FrameFeaturesBuilder::extend(KeypointCandidates& candidates, const cv::Mat& excluded, int wanted) {
  const int n_added = extractor_.extract_more(excluded, wanted, candidates.orb);
  complete(candidates);
  return n_added;
}

/// Undistorts the keypoints that have not been yet, and reads their depths.
void FrameFeaturesBuilder::complete(KeypointCandidates& candidates) const {
  const std::vector<OrbKeypoint>& found = candidates.orb.keypoints;
  candidates.undistorted.reserve(found.size());
  candidates.depth.reserve(found.size());
  for (std::size_t i = candidates.undistorted.size(); i < found.size(); ++i) {
    const OrbKeypoint& k = found[i];
    const Eigen::Vector2d distorted(static_cast<double>(k.x), static_cast<double>(k.y));
    const Eigen::Vector2d u = camera_.undistort(distorted);
    candidates.undistorted.push_back(
        {static_cast<float>(u.x()), static_cast<float>(u.y()), k.angle_deg, k.response, k.octave});
    // Depth is registered to the image as it was taken, so it is read at the distorted pixel.
    candidates.depth.push_back(follow_motion(read_depth(distorted), u));
  }
}

std::shared_ptr<const FrameFeatures> FrameFeaturesBuilder::finish(const KeypointCandidates& candidates,
                                                                  std::span<const std::uint8_t> keep) const {
  if (keep.size() != candidates.undistorted.size()) {
    throw InputError(std::to_string(keep.size()) + " decisions for " +
                     std::to_string(candidates.undistorted.size()) + " keypoints: one is needed for each");
  }
  auto features = std::make_shared<FrameFeatures>();
  const auto n =
      static_cast<std::size_t>(std::count_if(keep.begin(), keep.end(), [](auto k) { return k != 0; }));
  features->keypoints.reserve(n);
  features->descriptors.reserve(n);
  features->depth_m.reserve(n);
  features->depth_sigma_m.reserve(n);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) add_keypoint(candidates, i, *features);
  }
  derive(*features, camera_);
  return features;
}

std::shared_ptr<const FrameFeatures> FrameFeaturesBuilder::build(const cv::Mat& grey, const cv::Mat& depth,
                                                                 const SE3& depth_from_colour) {
  const KeypointCandidates& candidates = extract(grey, depth, depth_from_colour);
  return finish(candidates, std::vector<std::uint8_t>(candidates.undistorted.size(), 1));
}

void FrameFeaturesBuilder::add_keypoint(const KeypointCandidates& candidates, std::size_t i,
                                        FrameFeatures& features) const {
  const DepthReading& reading = candidates.depth[i];
  features.keypoints.push_back(candidates.undistorted[i]);
  features.descriptors.push_back(candidates.orb.descriptors[i]);
  features.depth_m.push_back(reading.depth_m);
  features.depth_sigma_m.push_back(reading.sigma_m);
}

DepthReading FrameFeaturesBuilder::read_depth(const Eigen::Vector2d& distorted_px) const {
  const auto x = static_cast<int>(std::lround(distorted_px.x()));
  const auto y = static_cast<int>(std::lround(distorted_px.y()));
  if (x < 0 || y < 0 || x >= depth_.cols || y >= depth_.rows) return {};
  return read_keypoint_depth(depth_, metres_per_unit_, x, y);
}

DepthReading FrameFeaturesBuilder::follow_motion(DepthReading reading,
                                                 const Eigen::Vector2d& undistorted_px) const {
  // Where the surface at this depth was seen by the depth camera, its reading corrects the depth; twice is
  // enough for a motion of a few pixels over a surface.
  constexpr int kIterations = 2;
  constexpr double kNearestM = 0.05;
  for (int i = 0; i < kIterations && reading.depth_m > 0.0F; ++i) {
    const Eigen::Vector3d in_depth_camera =
        depth_from_colour_ * camera_.back_project(undistorted_px, static_cast<double>(reading.depth_m));
    if (in_depth_camera.z() < kNearestM) return {};
    const DepthReading there = read_depth(camera_.distort(camera_.project(in_depth_camera)));
    reading.depth_m *= there.depth_m / static_cast<float>(in_depth_camera.z());
    reading.sigma_m = there.sigma_m;
  }
  return reading;
}

}  // namespace cpslam
