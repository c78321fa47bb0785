#include "detect/keypoint_flow.h"

#include <algorithm>
#include <cmath>

namespace cpslam {
namespace {

constexpr float kWindowPx = 32.0F;
constexpr float kDepthWindowM = 0.4F;
constexpr float kNearestM = 0.1F;
constexpr int kMaxDistance = 64;  // of descriptors, bits
constexpr float kRatio = 0.85F;   // to the second best

}  // namespace

Eigen::Vector3f lift(const PinholeCamera& camera, const DepthKeypoint& k) {
  const Eigen::Vector2d px(static_cast<double>(k.x), static_cast<double>(k.y));
  return camera
      .back_project(camera.has_distortion() ? camera.undistort(px) : px, static_cast<double>(k.depth_m))
      .cast<float>();
}

KeypointFlow::KeypointFlow(const PinholeCamera& camera, const FlowKeypoints& current)
    : camera_(camera), current_(current) {
  for (std::size_t i = 0; i < current.keypoints.size(); ++i) {
    if (current.keypoints[i].depth_m > 0.0F) by_row_.push_back(i);
  }
  std::sort(by_row_.begin(), by_row_.end(), [&current](std::size_t a, std::size_t b) {
    return current.keypoints[a].y < current.keypoints[b].y;
  });
}

int KeypointFlow::find(const Eigen::Vector3f& expected, const Descriptor& descriptor) const {
  if (expected.z() <= kNearestM) return -1;
  Eigen::Vector2d px = camera_.project(expected.cast<double>());
  if (camera_.has_distortion()) px = camera_.distort(px);
  const auto x = static_cast<float>(px.x());
  const auto y = static_cast<float>(px.y());
  int best = -1;
  int best_distance = kMaxDistance + 1;
  int second_distance = 256;
  const auto above = [&](std::size_t i) { return current_.keypoints[i].y - y < -kWindowPx; };
  for (auto at = std::partition_point(by_row_.begin(), by_row_.end(), above); at != by_row_.end(); ++at) {
    const std::size_t i = *at;
    const DepthKeypoint& k = current_.keypoints[i];
    if (k.y - y > kWindowPx) break;
    if (std::abs(k.x - x) > kWindowPx || std::abs(k.depth_m - expected.z()) > kDepthWindowM) continue;
    const int distance = descriptor_distance(descriptor, current_.descriptors[i]);
    if (distance < best_distance) {
      second_distance = best_distance;
      best_distance = distance;
      best = static_cast<int>(i);
    } else {
      second_distance = std::min(second_distance, distance);
    }
  }
  return static_cast<float>(best_distance) < kRatio * static_cast<float>(second_distance) ? best : -1;
}

}  // namespace cpslam
