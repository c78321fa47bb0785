#include "features/frame_features.h"

#include <cmath>

#include "features/image_check.h"

namespace cpslam {
FrameFeaturesBuilder::FrameFeaturesBuilder(const CameraSettings& camera, const OrbSettings& orb)
    : camera_(camera), metres_per_unit_(1.0 / camera.depth_map_factor), extractor_(orb) {}

std::shared_ptr<const FrameFeatures> FrameFeaturesBuilder::build(const cv::Mat& grey, const cv::Mat& depth,
                                                                 const SE3& depth_from_colour) {
  check_images(grey, depth, {camera_.width(), camera_.height()});
  extractor_.extract(grey, found_);
  auto features = std::make_shared<FrameFeatures>();
  const std::size_t n = found_.keypoints.size();
  features->keypoints.reserve(n);
  features->depth_m.reserve(n);
  features->disparity_px.reserve(n);
  features->depth_sigma_m.reserve(n);
  for (const OrbKeypoint& k : found_.keypoints) add_keypoint(k, depth, depth_from_colour, *features);
  features->descriptors = found_.descriptors;
  features->grid = KeypointGrid(features->keypoints, camera_.undistorted_bounds());
  return features;
}

void FrameFeaturesBuilder::add_keypoint(const OrbKeypoint& found, const cv::Mat& depth,
                                        const SE3& depth_from_colour, FrameFeatures& features) const {
  const Eigen::Vector2d distorted(static_cast<double>(found.x), static_cast<double>(found.y));
  const Eigen::Vector2d u = camera_.undistort(distorted);
  features.keypoints.push_back(
      {static_cast<float>(u.x()), static_cast<float>(u.y()), found.angle_deg, found.response, found.octave});
  // Depth is registered to the image as it was taken, so it is read at the distorted pixel.
  const DepthReading reading = follow_motion(read_depth(distorted, depth), u, depth, depth_from_colour);
  features.depth_m.push_back(reading.depth_m);
  features.depth_sigma_m.push_back(reading.sigma_m);
  features.disparity_px.push_back(reading.depth_m > 0.0F ? static_cast<float>(camera_.bf()) / reading.depth_m
                                                         : 0.0F);
}

DepthReading FrameFeaturesBuilder::read_depth(const Eigen::Vector2d& distorted_px,
                                              const cv::Mat& depth) const {
  const auto x = static_cast<int>(std::lround(distorted_px.x()));
  const auto y = static_cast<int>(std::lround(distorted_px.y()));
  if (x < 0 || y < 0 || x >= depth.cols || y >= depth.rows) return {};
  return read_keypoint_depth(depth, metres_per_unit_, x, y);
}

DepthReading FrameFeaturesBuilder::follow_motion(DepthReading reading, const Eigen::Vector2d& undistorted_px,
                                                 const cv::Mat& depth, const SE3& depth_from_colour) const {
  // Where the surface at this depth was seen by the depth camera, its reading corrects the depth; twice is
  // enough for a motion of a few pixels over a surface.
  constexpr int kIterations = 2;
  constexpr double kNearestM = 0.05;
  for (int i = 0; i < kIterations && reading.depth_m > 0.0F; ++i) {
    const Eigen::Vector3d in_depth_camera =
        depth_from_colour * camera_.back_project(undistorted_px, static_cast<double>(reading.depth_m));
    if (in_depth_camera.z() < kNearestM) return {};
    const DepthReading there = read_depth(camera_.distort(camera_.project(in_depth_camera)), depth);
    reading.depth_m *= there.depth_m / static_cast<float>(in_depth_camera.z());
    reading.sigma_m = there.sigma_m;
  }
  return reading;
}

}  // namespace cpslam
