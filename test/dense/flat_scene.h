#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "dense/dense_views.h"
#include "support/synthetic.h"
#include "util/random.h"

/// Views of planes, for the tests of the dense map.
namespace cpslam::flat {

/// normal . point = offset, in the world.
struct Plane {
  Eigen::Vector3d normal;
  double offset_m = 0.0;
  Eigen::AlignedBox3d within{Eigen::Vector3d::Constant(-100.0), Eigen::Vector3d::Constant(100.0)};
  std::array<std::uint8_t, 3> rgb{100, 150, 200};
};

inline Plane wall(double z_m) {
  return {{0.0, 0.0, 1.0}, z_m};
}

/// A piece of a wall between the camera and what is behind.
inline Plane board(double z_m, double half_side_m, std::array<std::uint8_t, 3> rgb = {200, 50, 50}) {
  Plane plane = wall(z_m);
  plane.within = Eigen::AlignedBox3d(Eigen::Vector3d(-half_side_m, -half_side_m, z_m - 0.01),
                                     Eigen::Vector3d(half_side_m, half_side_m, z_m + 0.01));
  plane.rgb = rgb;
  return plane;
}

/// Colour and exact depth in 1/5000 m of what a camera sees of planes; no reading where there is none.
inline DenseFrame look(const PinholeCamera& camera, const std::vector<Plane>& planes,
                       const SE3& world_from_camera = {}) {
  DenseFrame frame;
  frame.metres_per_unit = 1.0 / 5000.0;
  frame.depth = cv::Mat(camera.height(), camera.width(), CV_16UC1, cv::Scalar(0));
  frame.colour = cv::Mat(camera.height(), camera.width(), CV_8UC3, cv::Scalar());
  for (int y = 0; y < camera.height(); ++y) {
    for (int x = 0; x < camera.width(); ++x) {
      const Eigen::Vector3d ray_in_camera =
          camera.back_project(camera.undistort({static_cast<double>(x), static_cast<double>(y)}), 1.0);
      const Eigen::Vector3d ray = world_from_camera.rotation * ray_in_camera;
      double nearest_m = 13.0;
      for (const Plane& plane : planes) {
        const double d =
            (plane.offset_m - plane.normal.dot(world_from_camera.translation)) / plane.normal.dot(ray);
        const Eigen::Vector3d at = world_from_camera.translation + d * ray;
        if (!(d > 0.0) || d >= nearest_m || !plane.within.contains(at)) continue;
        nearest_m = d;
        frame.depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(std::lround(d * 5000.0));
        frame.colour.at<cv::Vec3b>(y, x) = {plane.rgb[2], plane.rgb[1], plane.rgb[0]};
      }
    }
  }
  return frame;
}

/// Adds the noise of a sensor to every reading.
inline void disturb(double sigma_m, Random& random, DenseFrame& frame) {
  for (auto& d : cv::Mat1w(frame.depth)) {
    if (d != 0)
      d = static_cast<std::uint16_t>(std::lround(std::max(1.0, d + 5000.0 * sigma_m * random.normal())));
  }
}

inline PinholeCamera camera() {
  return PinholeCamera(synthetic::settings().camera);
}

inline PlacedView place(const DenseCamera& camera, const DenseFrame& frame, const SE3& world_from_view = {}) {
  return {std::make_shared<const DenseView>(make_dense_view(camera, frame)), world_from_view};
}

}  // namespace cpslam::flat
