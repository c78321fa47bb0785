#include "end_to_end/dense_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "dense/voxel_grid.h"

namespace cpslam::e2e {
namespace {

constexpr int kJointFrameStep = 3;
// From a joint or a limb's end to the body's surface, clothes and hair, at most.
constexpr float kBodyM = 0.35F;

Eigen::Vector3f normal_at(const DenseCamera& camera, const cv::Mat1f& depth_m, int x, int y) {
  const auto point = [&](int u, int v) -> Eigen::Vector3f {
    return camera.ray(v * depth_m.cols + u) * depth_m(v, u);
  };
  const Eigen::Vector3f normal =
      (point(x, y + 1) - point(x, y - 1)).cross(point(x + 1, y) - point(x - 1, y)).normalized();
  return normal;
}

template <typename Value>
Value percentile(std::vector<Value>& values, double share) {
  if (values.empty()) return {};
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

DenseTruth::DenseTruth(const sim::SimulationOptions& options, const std::vector<int>& frames,
                       double max_depth_m)
    : camera_(PinholeCamera(options.camera)), max_depth_m_(static_cast<float>(max_depth_m)) {
  const sim::Simulation with_people(options);
  for (int i = 0; i < with_people.size(); i += kJointFrameStep) {
    for (int person = 0; person < with_people.n_people(); ++person) {
      for (const Eigen::Vector3d& joint : with_people.person_joints(person, i))
        joints_.emplace_back(joint.cast<float>());
    }
  }
  sim::SimulationOptions empty = options;
  empty.n_people = 0;
  empty.sensor_noise = false;
  sim::Simulation room(empty);
  for (const int i : frames) {
    const sim::SimulatedFrame frame = room.render(i);
    View view;
    view.world_from_camera = frame.world_from_camera;
    view.depth_m = cv::Mat1f(camera_.size(), 0.0F);
    for (int y = 0; y < view.depth_m.rows; ++y) {
      for (int x = 0; x < view.depth_m.cols; ++x) {
        const cv::Rect block(x * camera_.step(), y * camera_.step(), camera_.step(), camera_.step());
        const double units = cv::mean(frame.depth(block))[0];
        view.depth_m(y, x) = static_cast<float>(units / empty.camera.depth_map_factor);
      }
    }
    view.normal = cv::Mat3f(camera_.size(), cv::Vec3f());
    for (int y = 1; y + 1 < view.depth_m.rows; ++y) {
      for (int x = 1; x + 1 < view.depth_m.cols; ++x) {
        const Eigen::Vector3f n = normal_at(camera_, view.depth_m, x, y);
        view.normal(y, x) = {n.x(), n.y(), n.z()};
      }
    }
    views_.push_back(std::move(view));
  }
}

DenseTruth::Nearest DenseTruth::nearest_surface(const Eigen::Vector3f& point) const {
  Nearest nearest;
  float best_sight = 0.0F;
  for (const View& view : views_) {
    const Eigen::Vector3f in_camera = (view.world_from_camera.inverse() * point.cast<double>()).cast<float>();
    const int pixel = camera_.pixel_of(in_camera);
    if (pixel < 0) continue;
    const cv::Point at(pixel % view.depth_m.cols, pixel / view.depth_m.cols);
    const float depth_m = view.depth_m(at);
    if (depth_m <= 0.0F) continue;
    const cv::Vec3f& n = view.normal(at);
    const Eigen::Vector3f normal(n[0], n[1], n[2]);
    const Eigen::Vector3f off = in_camera - camera_.ray(pixel) * depth_m;
    // From the plane through the surface where the ray meets it: seen aslant, that is far along the ray.
    const float plane_m = std::abs(normal.dot(off));
    const float along_ray_m = std::abs(off.z());
    const bool aslant = along_ray_m <= 4.0F * kOnSurfaceM && plane_m <= kOnSurfaceM;
    if (along_ray_m > kOnSurfaceM && !aslant) continue;
    nearest.on_surface = true;
    const float sight = -normal.dot(camera_.ray(pixel).normalized()) / (depth_m * depth_m);
    if (sight <= best_sight) continue;
    best_sight = sight;
    nearest.error_m = plane_m;
    nearest.normal = view.world_from_camera.rotation.cast<float>() * normal;
  }
  return nearest;
}

bool DenseTruth::is_on_a_path(const Eigen::Vector3f& point) const {
  return std::any_of(joints_.begin(), joints_.end(), [&](const Eigen::Vector3f& joint) {
    return (joint - point).squaredNorm() < kBodyM * kBodyM;
  });
}

double DenseTruth::completeness(const std::vector<Eigen::Vector3f>& points) const {
  const auto cell_of = [](const Eigen::Vector3f& point) {
    return Eigen::Vector3i((point.array() / kOnSurfaceM).floor().cast<int>());
  };
  std::unordered_set<VoxelKey> cells;
  for (const Eigen::Vector3f& point : points) {
    for (int i = 0; i < 27; ++i)
      cells.insert(voxel_key(cell_of(point) + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
  }
  std::size_t n = 0, found = 0;
  constexpr int kPixelStep = 4;
  for (const View& view : views_) {
    for (int y = kPixelStep; y < view.depth_m.rows; y += kPixelStep) {
      for (int x = kPixelStep; x < view.depth_m.cols; x += kPixelStep) {
        const float d = view.depth_m(y, x);
        if (d <= 0.0F || d > max_depth_m_) continue;
        const Eigen::Vector3d surface =
            view.world_from_camera * (camera_.ray(y * view.depth_m.cols + x) * d).cast<double>();
        ++n;
        found += cells.contains(voxel_key(cell_of(surface.cast<float>()))) ? 1U : 0U;
      }
    }
  }
  return n > 0 ? static_cast<double>(found) / static_cast<double>(n) : 0.0;
}

DenseScore DenseTruth::score(std::span<const CloudPoint> points, const SE3& truth_from_map) const {
  DenseScore score;
  score.points = points.size();
  if (points.empty()) return score;
  std::vector<float> errors_m, angles_deg;
  std::vector<Eigen::Vector3f> in_truth;
  std::size_t n_off = 0, n_ghosts = 0;
  for (const CloudPoint& p : points) {
    const auto& [x, y, z] = p.position_m;
    in_truth.emplace_back((truth_from_map * Eigen::Vector3d(x, y, z)).cast<float>());
    const Nearest nearest = nearest_surface(in_truth.back());
    if (!nearest.on_surface) {
      ++n_off;
      n_ghosts += is_on_a_path(in_truth.back()) ? 1U : 0U;
      continue;
    }
    errors_m.push_back(nearest.error_m);
    const Eigen::Vector3f normal =
        truth_from_map.rotation.cast<float>() * Eigen::Vector3f(p.normal[0], p.normal[1], p.normal[2]);
    const float cosine = std::clamp(normal.dot(nearest.normal), -1.0F, 1.0F);
    angles_deg.push_back(std::acos(cosine) * 180.0F / std::numbers::pi_v<float>);
  }
  const auto share = [&](std::size_t n) {
    return static_cast<double>(n) / static_cast<double>(points.size());
  };
  score.off_share = share(n_off);
  score.ghost_share = share(n_ghosts);
  score.median_error_m = percentile(errors_m, 0.5);
  score.p95_error_m = percentile(errors_m, 0.95);
  score.normal_error_deg = percentile(angles_deg, 0.5);
  score.completeness = completeness(in_truth);
  return score;
}

}  // namespace cpslam::e2e
