#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "cpslam/dense_map.h"
#include "dense/dense_camera.h"
#include "geometry/se3.h"
#include "sim/simulation.h"

namespace cpslam::e2e {

/// What a dense map of a simulated room is worth.
struct DenseScore {
  std::size_t points = 0;
  double median_error_m = 0.0;  ///< of the points on a surface, from it
  double p95_error_m = 0.0;
  double off_share = 0.0;         ///< of the points: farther than kOnSurfaceM from any surface
  double ghost_share = 0.0;       ///< of the points: that, and where somebody was
  double completeness = 0.0;      ///< share of the surface that the camera passed with a point that near
  double normal_error_deg = 0.0;  ///< median
};

/// The surfaces of a simulated room without its people, and where these went.
class DenseTruth {
 public:
  /// options: of the sequence; frames: those that the map was made of, and any more to look from;
  /// max_depth_m: surface farther from every camera is not asked for.
  DenseTruth(const sim::SimulationOptions& options, const std::vector<int>& frames, double max_depth_m);

  /// truth_from_map: from the map's world into the simulator's.
  [[nodiscard]] DenseScore score(std::span<const CloudPoint> points, const SE3& truth_from_map) const;

  static constexpr float kOnSurfaceM = 0.05F;

 private:
  struct View {
    cv::Mat1f depth_m;
    cv::Mat3f normal;  // camera frame
    SE3 world_from_camera;
  };
  struct Nearest {
    bool on_surface = false;  ///< for some view
    float error_m = 1e9F;  ///< for the view that sees the place best, of those for which it is on a surface
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  };
  [[nodiscard]] Nearest nearest_surface(const Eigen::Vector3f& point) const;
  [[nodiscard]] bool is_on_a_path(const Eigen::Vector3f& point) const;
  [[nodiscard]] double completeness(const std::vector<Eigen::Vector3f>& points) const;

  DenseCamera camera_;
  float max_depth_m_;
  std::vector<View> views_;
  std::vector<Eigen::Vector3f> joints_;  // of everybody at all times
};

}  // namespace cpslam::e2e
