// Tracks three frames made on the fly through the installed library; exits 0 when the last one is tracked.
#include <cpslam/system.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <opencv2/core.hpp>
#include <random>

namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kWallDepth_m = 2.0;

cpslam::Settings small_camera() {
  cpslam::Settings settings;
  settings.camera.width = kWidth;
  settings.camera.height = kHeight;
  settings.camera.fx = settings.camera.fy = 260.0;
  settings.camera.cx = kWidth / 2.0;
  settings.camera.cy = kHeight / 2.0;
  settings.sequential = true;
  settings.check();
  return settings;
}

/// A wall of overlapping rectangles of all sizes: corners at every scale. Wider than the image, to move along
/// it.
cv::Mat painted_wall() {
  cv::Mat wall(kHeight, kWidth + 20, CV_8UC3, cv::Scalar(90, 100, 110));
  std::mt19937 random(7);
  for (int i = 0; i < 1500; ++i) {
    const int width = 6 + static_cast<int>(random() % 40U);
    const int height = 6 + static_cast<int>(random() % 40U);
    const int x = static_cast<int>(random() % static_cast<unsigned>(wall.cols - width));
    const int y = static_cast<int>(random() % static_cast<unsigned>(wall.rows - height));
    const cv::Scalar colour(static_cast<double>(random() % 256U), static_cast<double>(random() % 256U),
                            static_cast<double>(random() % 256U));
    wall(cv::Rect(x, y, width, height)).setTo(colour);
  }
  return wall;
}

const char* name_of(cpslam::TrackingState state) {
  switch (state) {
    case cpslam::TrackingState::kNotInitialized:
      return "not initialized";
    case cpslam::TrackingState::kTracked:
      return "tracked";
    case cpslam::TrackingState::kWeak:
      return "weakly tracked";
    case cpslam::TrackingState::kPredicted:
      return "predicted";
    case cpslam::TrackingState::kLost:
      return "lost";
  }
  return "unknown";
}

}  // namespace

int main() try {
  const cpslam::Settings settings = small_camera();
  const auto depth_units = static_cast<std::uint16_t>(kWallDepth_m * settings.camera.depth_map_factor);
  const cv::Mat depth(kHeight, kWidth, CV_16UC1, cv::Scalar(depth_units));
  const cv::Mat wall = painted_wall();

  cpslam::System system(settings);
  cpslam::TrackResult result;
  for (int frame = 0; frame < 3; ++frame) {
    // Two pixels a frame along the wall: 2 * 2 m / 260 = 15 mm to the right.
    const cv::Mat colour = wall(cv::Rect(2 * frame, 0, kWidth, kHeight)).clone();
    result = system.track(colour, depth, frame / 30.0);
    std::cout << "frame " << frame << ": " << name_of(result.state) << ", " << result.n_inliers
              << " inliers\n";
  }
  system.shutdown();

  const double moved_m = result.world_from_camera.translation_m[0];
  const double expected_m = 4.0 * kWallDepth_m / settings.camera.fx;
  std::cout << "moved " << moved_m << " m, expected " << expected_m << " m, " << system.trajectory().size()
            << " poses\n";
  const bool right = moved_m > expected_m - 0.005 && moved_m < expected_m + 0.005;
  return cpslam::is_tracked(result.state) && right && system.trajectory().size() == 3 ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "consumer: " << error.what() << '\n';
  return 1;
}
