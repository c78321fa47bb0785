#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/core.hpp>

#include "cpslam/settings.h"
#include "cpslam/snapshot.h"
#include "geometry/se3.h"
#include "geometry/world_point.h"
#include "util/random.h"

/// Snapshots of a made-up room, in the world of a level first camera (y down).
namespace cpslam::viewer::sample {

inline CameraSettings camera() {
  CameraSettings camera;
  camera.fx = camera.fy = 525.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

/// A point on the floor or a wall of a room of 8 x 6 x 2.6 m, the camera 1.4 m above the floor.
inline Eigen::Vector3d wall_point(Random& random) {
  Eigen::Vector3d p(random.uniform(-4.0, 4.0), random.uniform(-1.2, 1.4), random.uniform(-3.0, 3.0));
  switch (random.index(5)) {
    case 0:
      p.x() = -4.0;
      break;
    case 1:
      p.x() = 4.0;
      break;
    case 2:
      p.z() = -3.0;
      break;
    case 3:
      p.z() = 3.0;
      break;
    default:
      p.y() = 1.4;
      break;
  }
  return p;
}

/// On a walk once round the room, looking outwards; share of the way in [0, 1).
inline Pose pose_at(double share) {
  const double angle = 2.0 * std::numbers::pi * share;
  const SE3 world_from_camera(so3_exp({0.0, angle, 0.0}),
                              {2.0 * std::sin(angle), 0.0, 1.5 * std::cos(angle)});
  return to_pose(world_from_camera);
}

inline MapSnapshot map(std::size_t n_points, std::uint32_t n_keyframes) {
  constexpr std::size_t kFramesPerKeyFrame = 10;
  Random random(1);
  MapSnapshot map;
  for (std::size_t i = 0; i < n_points; ++i) map.points.push_back(to_world_point(wall_point(random)));
  const double n_frames = static_cast<double>(n_keyframes * kFramesPerKeyFrame);
  for (std::size_t i = 0; i < n_keyframes * kFramesPerKeyFrame; ++i) {
    const double at = static_cast<double>(i);
    map.trajectory.push_back({at / 30.0, pose_at(0.95 * at / n_frames)});
    if (i % kFramesPerKeyFrame == 0) map.keyframes.push_back(map.trajectory.back());
  }
  for (std::uint32_t k = 1; k < n_keyframes; ++k) {
    map.spanning_tree.push_back({k, k - 1});
    for (std::uint32_t back = 1; back <= std::min(k, 3U); ++back) map.covisibility.push_back({k, k - back});
  }
  if (n_keyframes > 1) map.loops.push_back({n_keyframes - 1, 0});
  return map;
}

inline PersonShape person(std::uint8_t number, const Eigen::Vector3d& feet) {
  PersonShape shape;
  shape.number = number;
  shape.spacing_m = 0.03F;
  shape.velocity_m_per_s = {0.9F, 0.0F, 0.0F};
  for (int row = 0; row < 58; ++row) {
    for (int column = 0; column < 16; ++column) {
      const double angle = 0.2 * column;
      shape.surface.push_back(to_world_point(Eigen::Vector3d(
          feet + Eigen::Vector3d(0.25 * std::cos(angle), -0.03 * row, -0.2 * std::sin(angle)))));
    }
  }
  return shape;
}

/// A grey image, somebody in a box in the middle of it, and keypoints of every kind.
inline FrameSnapshot frame(std::uint64_t index) {
  FrameSnapshot frame;
  frame.index = index;
  frame.result.state = TrackingState::kTracked;
  frame.result.time_s = static_cast<double>(index) / 30.0;
  frame.result.world_from_camera = pose_at(0.94);
  frame.result.n_inliers = 321;
  frame.image = cv::Mat(480, 640, CV_8UC3, cv::Scalar(90, 100, 110));
  frame.view.time_s = frame.result.time_s;
  frame.view.boxes_time_s = frame.result.time_s - 0.05;
  frame.view.boxes.push_back({250.0, 100.0, 140.0, 340.0, 0.93});
  frame.view.person_mask = cv::Mat::zeros(480, 640, CV_8UC1);
  frame.view.person_mask(cv::Rect(270, 120, 100, 310)) = std::uint8_t{2};
  for (int y = 20; y < 480; y += 20) {
    for (int x = 20; x < 640; x += 20) {
      const bool his = frame.view.person_mask.at<std::uint8_t>(y, x) != 0;
      const auto kind = his                 ? FrameView::Kind::kRemoved
                        : (x + y) % 60 == 0 ? FrameView::Kind::kKept
                                            : FrameView::Kind::kTracked;
      frame.view.keypoints.push_back({static_cast<float>(x), static_cast<float>(y), kind});
    }
  }
  frame.people.push_back(person(2, {0.5, 1.4, 0.3}));
  const double frames = static_cast<double>(index + 1);
  const auto stage = [&](const char* name, double ms) {
    frame.stages.push_back({name, index + 1, ms, 1.3 * ms, 2.0 * ms, ms * frames});
  };
  stage("track", 9.0);
  stage("track: features", 4.0);
  stage("people: carry", 1.0);
  stage("people: judge keypoints", 0.5);
  stage("track: wait for boxes", 1.0);
  stage("track: local map", 2.0);
  return frame;
}

}  // namespace cpslam::viewer::sample
