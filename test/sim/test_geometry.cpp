#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera/pinhole_camera.h"
#include "sim/simulation.h"

namespace cpslam::sim {
namespace {

Eigen::Vector3d world_point(const SimulatedFrame& frame, const PinholeCamera& camera, int x, int y,
                            double depth_m) {
  return frame.world_from_camera * camera.back_project(camera.undistort(Eigen::Vector2d(x, y)), depth_m);
}

struct WarpResult {
  int agree = 0, disagree = 0, hidden = 0;
  double colour_difference = 0.0;  // mean over the agreeing, grey levels
};

// Carries pixels of one frame into another by depth and truth, and compares.
WarpResult warp(const SimulatedFrame& from, const SimulatedFrame& to, const CameraSettings& settings) {
  const PinholeCamera camera(settings);
  const SE3 to_from_world = to.world_from_camera.inverse();
  WarpResult result;
  for (int y = 2; y < from.depth.rows; y += 3) {
    for (int x = 2; x < from.depth.cols; x += 3) {
      const double depth_m = from.depth.at<std::uint16_t>(y, x) / settings.depth_map_factor;
      if (depth_m == 0.0) continue;
      const Eigen::Vector3d point = to_from_world * world_point(from, camera, x, y, depth_m);
      if (point.z() < 0.1) continue;
      const Eigen::Vector2d pixel = camera.distort(camera.project(point));
      const int left = static_cast<int>(std::floor(pixel.x()));
      const int top = static_cast<int>(std::floor(pixel.y()));
      if (left < 1 || top < 1 || left + 2 >= to.depth.cols || top + 2 >= to.depth.rows) continue;
      double nearest = 1e9, farthest = 0.0;
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const double other = to.depth.at<std::uint16_t>(top + dy, left + dx) / settings.depth_map_factor;
          nearest = std::min(nearest, other);
          farthest = std::max(farthest, other);
        }
      }
      if (nearest < point.z() - 0.05) {
        ++result.hidden;
      } else if (point.z() > nearest - 0.01 && point.z() < farthest + 0.01) {
        ++result.agree;
        const auto& a = from.colour_bgr.at<cv::Vec3b>(y, x);
        const auto& b = to.colour_bgr.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y())),
                                                    static_cast<int>(std::lround(pixel.x())));
        for (int i = 0; i < 3; ++i) result.colour_difference += std::abs(a[i] - b[i]) / 3.0;
      } else {
        ++result.disagree;
      }
    }
  }
  result.colour_difference /= std::max(1, result.agree);
  return result;
}

void expect_consistent(const SimulationOptions& options, int first, int second) {
  Simulation simulation(options);
  const WarpResult result = warp(simulation.render(first), simulation.render(second), simulation.camera());
  const int compared = result.agree + result.disagree;
  EXPECT_GT(compared, 15000) << options.preset;
  EXPECT_LT(result.hidden, compared / 2) << options.preset;
  EXPECT_GE(result.agree, 0.98 * compared) << options.preset;
  EXPECT_LT(result.colour_difference, 10.0) << options.preset;
}

TEST(SimulationGeometry, FramesAgreeThroughDepthAndTruth) {
  for (const char* preset : {"office_halfsphere", "office_rpy", "ring"}) {
    SimulationOptions options;
    options.preset = preset;
    options.seed = 2;
    expect_consistent(options, 100, 112);
  }
}

TEST(SimulationGeometry, FramesAgreeWithDistortion) {
  SimulationOptions options;
  options.preset = "office_halfsphere";
  options.camera.fx = 517.306408;
  options.camera.fy = 516.469215;
  options.camera.cx = 318.643040;
  options.camera.cy = 255.313989;
  options.camera.k1 = 0.262383;
  options.camera.k2 = -0.953104;
  options.camera.p1 = -0.005358;
  options.camera.p2 = 0.002628;
  options.camera.k3 = 1.163314;
  expect_consistent(options, 100, 112);
}

TEST(SimulationGeometry, AWrongPoseIsNoticed) {
  SimulationOptions options;
  options.preset = "office_halfsphere";
  Simulation simulation(options);
  SimulatedFrame first = simulation.render(100);
  const SimulatedFrame second = simulation.render(112);
  first.world_from_camera.translation.x() += 0.04;
  const WarpResult result = warp(first, second, simulation.camera());
  EXPECT_LT(result.agree, 0.8 * (result.agree + result.disagree));
}

// Depth is quantised to 0.2 mm; nothing may lie outside the room, and plain walls and floor exactly on its
// faces.
TEST(SimulationGeometry, AllDepthLiesInsideTheRoomAndWallsAreFlat) {
  SimulationOptions options;
  options.preset = "office_rpy";
  Simulation simulation(options);
  ASSERT_EQ(simulation.rooms().size(), 1U);
  const Eigen::AlignedBox3d room = simulation.rooms().front().cast<double>();
  const PinholeCamera camera(simulation.camera());
  int n = 0, n_outside = 0, n_on_faces = 0;
  for (const int index : {0, 60, 120, 180}) {
    const SimulatedFrame frame = simulation.render(index);
    for (int y = 0; y < frame.depth.rows; y += 2) {
      for (int x = 0; x < frame.depth.cols; x += 2) {
        const double depth_m = frame.depth.at<std::uint16_t>(y, x) / simulation.camera().depth_map_factor;
        ASSERT_GT(depth_m, 0.0) << "a hole in the room at " << x << ", " << y << " of frame " << index;
        const Eigen::Vector3d point = world_point(frame, camera, x, y, depth_m);
        const double inside = std::min((point - room.min()).minCoeff(), (room.max() - point).minCoeff());
        ++n;
        n_outside += inside < -3e-4 ? 1 : 0;
        n_on_faces += std::abs(inside) <= 3e-4 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(n_outside, 0);
  EXPECT_GT(n_on_faces, n / 5);
}

TEST(SimulationGeometry, GroundTruthIsTheFramesPoses) {
  SimulationOptions options;
  options.n_frames = 5;
  Simulation simulation(options);
  const Trajectory truth = simulation.ground_truth();
  ASSERT_EQ(truth.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const SimulatedFrame frame = simulation.render(i);
    EXPECT_EQ(frame.time_s, truth[static_cast<std::size_t>(i)].time_s);
    const SE3 difference =
        from_pose(truth[static_cast<std::size_t>(i)].world_from_camera) * frame.world_from_camera.inverse();
    EXPECT_LT(difference.log().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace cpslam::sim
