#include "dense/surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

/// Blocks to each side that a plane is fitted to, and how many of these 25 must be on it.
constexpr int kReach = 2;
constexpr int kMinOnSurface = 15;
/// How far (m, and relative) the depths of one surface may be apart over the reach: a floor at 15 degrees.
constexpr float kSpreadM = 0.02F;
constexpr float kRelativeSpread = 0.035F;
/// Cosine between normal and ray below which it is a rim, or as good as one.
constexpr float kMinCosine = 0.12F;

/// inverse depth = at_centre + slope . (ray - centre's ray)
struct InverseDepthPlane {
  float at_centre = 0.0F;
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();
};

std::optional<InverseDepthPlane> fit_plane(const DenseCamera& camera, const cv::Mat1f& depth_m,
                                           const cv::Point& centre) {
  const float centre_m = depth_m(centre);
  const float spread_m = kSpreadM + kRelativeSpread * centre_m;
  const Eigen::Vector3f& centre_ray = camera.ray(centre.y * depth_m.cols + centre.x);
  const cv::Rect around = cv::Rect(centre.x - kReach, centre.y - kReach, 2 * kReach + 1, 2 * kReach + 1) &
                          cv::Rect({}, depth_m.size());
  Eigen::Matrix3f products = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  int n = 0;
  for (int y = around.y; y < around.br().y; ++y) {
    for (int x = around.x; x < around.br().x; ++x) {
      const float d = depth_m(y, x);
      if (d <= 0.0F || std::abs(d - centre_m) > spread_m) continue;
      // The unit of length of a ray's offset keeps the equations well conditioned.
      const Eigen::Vector2f offset =
          (camera.ray(y * depth_m.cols + x) - centre_ray).head<2>() * static_cast<float>(depth_m.cols);
      const Eigen::Vector3f row(1.0F, offset.x(), offset.y());
      products += row * row.transpose();
      right += row / d;
      ++n;
    }
  }
  if (n < kMinOnSurface) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3f> solver(products);
  const Eigen::Vector3f solution = solver.solve(right);
  if (solver.info() != Eigen::Success || !solution.allFinite() || !(solution.x() > 0.0F)) return std::nullopt;
  if (std::abs(1.0F / solution.x() - centre_m) > spread_m) return std::nullopt;
  return InverseDepthPlane{solution.x(), solution.tail<2>() * static_cast<float>(depth_m.cols)};
}

float weight_at(float depth_m) {
  const double relative = structured_light_sigma_m(1.0) / structured_light_sigma_m(depth_m);
  return static_cast<float>(relative * relative);
}

}  // namespace

std::vector<SurfacePoint> surface_points(const DenseCamera& camera, const DenseView& view,
                                         float max_depth_m) {
  cv::Mat1f depth_m;
  view.depth.convertTo(depth_m, CV_32F, 1.0 / DenseView::kUnitsPerM);
  std::vector<SurfacePoint> points;
  for (int pixel = 0; pixel < camera.n_pixels(); ++pixel) {
    const cv::Point at(pixel % depth_m.cols, pixel / depth_m.cols);
    if (depth_m(at) <= 0.0F || depth_m(at) > max_depth_m) continue;
    const auto plane = fit_plane(camera, depth_m, at);
    if (!plane) continue;
    const Eigen::Vector3f& ray = camera.ray(pixel);
    // All points of the plane have (slope, rest) . point = 1, so that this is its normal, away from the
    // camera.
    const float rest = plane->at_centre - plane->slope.dot(ray.head<2>());
    const Eigen::Vector3f away = Eigen::Vector3f(plane->slope.x(), plane->slope.y(), rest).normalized();
    const float cosine = away.dot(ray.normalized());
    if (!(cosine > kMinCosine)) continue;
    const float d = 1.0F / plane->at_centre;
    points.push_back({ray * d, -away, weight_at(d) * cosine, pixel});
  }
  return points;
}

}  // namespace cpslam
