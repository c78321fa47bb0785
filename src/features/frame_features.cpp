#include "features/frame_features.h"

#include <cmath>
#include <string>

#include "cpslam/error.h"
#include "features/keypoint_depth.h"

namespace cpslam {
namespace {

std::string size_text(cv::Size size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

FrameFeaturesBuilder::FrameFeaturesBuilder(const CameraSettings& camera, const OrbSettings& orb)
    : camera_(camera), metres_per_unit_(1.0 / camera.depth_map_factor), extractor_(orb) {}

std::shared_ptr<const FrameFeatures> FrameFeaturesBuilder::build(const cv::Mat& grey, const cv::Mat& depth) {
  check(grey, depth);
  extractor_.extract(grey, found_);
  auto features = std::make_shared<FrameFeatures>();
  const std::size_t n = found_.keypoints.size();
  features->keypoints.reserve(n);
  features->depth_m.reserve(n);
  features->right_u.reserve(n);
  features->depth_sigma_m.reserve(n);
  for (const OrbKeypoint& k : found_.keypoints) add_keypoint(k, depth, *features);
  features->descriptors = found_.descriptors;
  features->grid = KeypointGrid(features->keypoints, camera_.undistorted_bounds());
  return features;
}

void FrameFeaturesBuilder::check(const cv::Mat& grey, const cv::Mat& depth) const {
  const cv::Size expected(camera_.width(), camera_.height());
  if (grey.size() != expected) {
    throw InputError("colour image of " + size_text(grey.size()) +
                     " px, but Camera.width and Camera.height say " + size_text(expected) +
                     ": give the settings of this camera");
  }
  if (depth.size() != grey.size()) {
    throw InputError("depth image of " + size_text(depth.size()) + " px beside a colour image of " +
                     size_text(grey.size()) + " px: depth must be registered to colour");
  }
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw InputError("depth image of OpenCV type " + std::to_string(depth.type()) +
                     ": it must have one channel of 16-bit integers or 32-bit floats");
  }
}

void FrameFeaturesBuilder::add_keypoint(const OrbKeypoint& found, const cv::Mat& depth,
                                        FrameFeatures& features) const {
  const Eigen::Vector2d u = camera_.undistort({static_cast<double>(found.x), static_cast<double>(found.y)});
  features.keypoints.push_back(
      {static_cast<float>(u.x()), static_cast<float>(u.y()), found.angle_deg, found.response, found.octave});
  // Depth is registered to the image as it was taken, so it is read at the distorted pixel.
  const DepthReading reading =
      read_keypoint_depth(depth, metres_per_unit_, static_cast<int>(std::lround(found.x)),
                          static_cast<int>(std::lround(found.y)));
  features.depth_m.push_back(reading.depth_m);
  features.depth_sigma_m.push_back(reading.sigma_m);
  const bool has_depth = reading.depth_m > 0.0F;
  features.right_u.push_back(
      has_depth ? static_cast<float>(camera_.virtual_right(u.x(), static_cast<double>(reading.depth_m)))
                : -1.0F);
}

}  // namespace cpslam
