#include "slam/point_creation.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <shared_mutex>

#include "match/orb_matcher.h"
#include "slam/observation_model.h"
#include "util/median.h"

namespace cpslam {
namespace {

constexpr std::size_t kNeighbours = 10;
// Rays closer to parallel than this (1.15 degrees) fix no depth.
constexpr double kMaxRayCosine = 0.9998;

/// What triangulation needs of a keyframe, copied out of the map.
struct View {
  KeyFrameId id;
  SE3 cam_from_world;
  SE3 world_from_cam;
  std::shared_ptr<const FrameFeatures> features;
  std::vector<int> free_keypoints;  // without a map point
};

std::optional<View> copy_view(const Map& map, KeyFrameId id) {
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr) return std::nullopt;
  View view{id, keyframe->cam_from_world, keyframe->cam_from_world.inverse(), keyframe->features, {}};
  for (std::size_t i = 0; i < keyframe->points.size(); ++i) {
    if (!keyframe->points[i].valid()) view.free_keypoints.push_back(static_cast<int>(i));
  }
  return view;
}

EpipolarGeometry epipolar_geometry(const Rig& rig, const View& a, const View& b) {
  const SE3 b_from_a = b.cam_from_world * a.world_from_cam;
  Eigen::Matrix3d k;
  k << rig.camera.fx(), 0.0, rig.camera.cx(), 0.0, rig.camera.fy(), rig.camera.cy(), 0.0, 0.0, 1.0;
  const Eigen::Matrix3d k_inverse = k.inverse();
  EpipolarGeometry geometry;
  geometry.fundamental_ba =
      k_inverse.transpose() * skew(b_from_a.translation) * b_from_a.rotation * k_inverse;
  const Eigen::Vector3d epipole = k * b_from_a.translation;
  // A sideways motion has its epipole at infinity: nothing is near it.
  geometry.epipole_in_b = std::abs(epipole.z()) > 1e-9 ? Eigen::Vector2d(epipole.head<2>() / epipole.z())
                                                       : Eigen::Vector2d(1e9, 1e9);
  return geometry;
}

Eigen::Vector3d ray_in_world(const Rig& rig, const View& view, int keypoint) {
  const Keypoint& k = view.features->keypoints[static_cast<std::size_t>(keypoint)];
  return (view.world_from_cam.rotation * rig.camera.back_project({k.x, k.y}, 1.0)).normalized();
}

/// Cosine of the angle under which a depth sensor's virtual baseline sees the keypoint; 2 without depth.
double depth_cosine(const Rig& rig, const View& view, int keypoint) {
  const double depth_m = view.features->depth_m[static_cast<std::size_t>(keypoint)];
  if (depth_m <= 0.0) return 2.0;
  const double half_baseline_m = 0.5 * rig.camera.bf() / rig.camera.fx();
  return std::cos(2.0 * std::atan2(half_baseline_m, depth_m));
}

/// Linear triangulation (Hartley and Zisserman 2003, 12.2) on normalised rays.
std::optional<Eigen::Vector3d> triangulate(const Rig& rig, const View& a, int in_a, const View& b, int in_b) {
  Eigen::Matrix4d system;
  const auto fill = [&](const View& view, int keypoint, int row) {
    const Keypoint& k = view.features->keypoints[static_cast<std::size_t>(keypoint)];
    const Eigen::Vector3d ray = rig.camera.back_project({k.x, k.y}, 1.0);
    Eigen::Matrix<double, 3, 4> projection;
    projection << view.cam_from_world.rotation, view.cam_from_world.translation;
    system.row(row) = ray.x() * projection.row(2) - projection.row(0);
    system.row(row + 1) = ray.y() * projection.row(2) - projection.row(1);
  };
  fill(a, in_a, 0);
  fill(b, in_b, 2);
  const Eigen::JacobiSVD<Eigen::Matrix4d> svd(system, Eigen::ComputeFullV);
  const Eigen::Vector4d solution = svd.matrixV().col(3);
  if (std::abs(solution.w()) < 1e-12) return std::nullopt;
  return Eigen::Vector3d(solution.head<3>() / solution.w());
}

std::optional<Eigen::Vector3d> place(const Rig& rig, const View& a, int in_a, const View& b, int in_b) {
  const double ray_cosine = ray_in_world(rig, a, in_a).dot(ray_in_world(rig, b, in_b));
  const double cosine_a = depth_cosine(rig, a, in_a);
  const double cosine_b = depth_cosine(rig, b, in_b);
  const bool has_depth = cosine_a <= 1.0 || cosine_b <= 1.0;
  const double best_depth_cosine = std::min(cosine_a, cosine_b);
  if (ray_cosine > 0.0 && ray_cosine < best_depth_cosine && (has_depth || ray_cosine < kMaxRayCosine)) {
    return triangulate(rig, a, in_a, b, in_b);
  }
  if (!has_depth) return std::nullopt;
  if (cosine_a <= cosine_b) return a.world_from_cam * back_project(rig, *a.features, in_a);
  return b.world_from_cam * back_project(rig, *b.features, in_b);
}

bool agrees(const Rig& rig, const View& view, int keypoint, const Eigen::Vector3d& point_in_world) {
  const PointObservation seen = observe(rig, *view.features, keypoint);
  return chi2(rig, seen, view.cam_from_world * point_in_world) < chi2_gate(seen);
}

/// The ratio of distances must fit the ratio of pyramid levels.
bool scale_agrees(const Rig& rig, const View& a, int in_a, const View& b, int in_b,
                  const Eigen::Vector3d& point) {
  const double distance_a = (point - a.world_from_cam.translation).norm();
  const double distance_b = (point - b.world_from_cam.translation).norm();
  if (distance_a <= 0.0 || distance_b <= 0.0) return false;
  const auto factor = [&](const View& view, int keypoint) {
    const int octave = view.features->keypoints[static_cast<std::size_t>(keypoint)].octave;
    return static_cast<double>(rig.pyramid.factor[static_cast<std::size_t>(octave)]);
  };
  const double mismatch = distance_b / distance_a * factor(a, in_a) / factor(b, in_b);
  const double tolerance = 1.5 * rig.settings.orb.scale_factor;
  return mismatch < tolerance && mismatch > 1.0 / tolerance;
}

double median_depth(const Map& map, const KeyFrame& keyframe) {
  std::vector<double> depths;
  for (const MapPointId id : keyframe.points) {
    if (const MapPoint* point = map.point(id)) {
      depths.push_back((keyframe.cam_from_world * point->position_in_world).z());
    }
  }
  if (depths.empty()) return 0.0;
  return median(depths);
}

/// The neighbours far enough away to give parallax; depth gives what the virtual baseline gives without
/// moving.
std::vector<KeyFrameId> useful_neighbours(const Rig& rig, const Map& map, KeyFrameId id) {
  std::vector<KeyFrameId> useful;
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr) return useful;
  const double least_baseline_m =
      std::min(rig.camera.bf() / rig.camera.fx(), 0.01 * median_depth(map, *keyframe));
  for (const KeyFrameId other : map.best_covisible(id, kNeighbours)) {
    const double baseline_m = (map.keyframe(other)->centre_in_world() - keyframe->centre_in_world()).norm();
    if (baseline_m >= least_baseline_m) useful.push_back(other);
  }
  return useful;
}

struct NewPoint {
  int in_a;
  int in_b;
  Eigen::Vector3d position;
};

std::vector<NewPoint> find_new_points(const Rig& rig, const View& a, const View& b) {
  MatchOptions options;
  options.max_distance = kStrictDistance;
  options.check_rotation = true;
  std::vector<NewPoint> found;
  for (const KeypointMatch& match :
       match_by_epipolar_line({*a.features, a.free_keypoints}, {*b.features, b.free_keypoints},
                              epipolar_geometry(rig, a, b), rig.pyramid, options)) {
    const auto position = place(rig, a, match.a, b, match.b);
    if (position && agrees(rig, a, match.a, *position) && agrees(rig, b, match.b, *position) &&
        scale_agrees(rig, a, match.a, b, match.b, *position)) {
      found.push_back({match.a, match.b, *position});
    }
  }
  return found;
}

}  // namespace

std::vector<MapPointId> create_points(const Rig& rig, Map& map, KeyFrameId keyframe) {
  std::vector<KeyFrameId> neighbours;
  {
    const std::shared_lock lock(map.mutex());
    neighbours = useful_neighbours(rig, map, keyframe);
  }
  std::vector<MapPointId> created;
  for (const KeyFrameId neighbour : neighbours) {
    std::optional<View> a;
    std::optional<View> b;
    {
      const std::shared_lock lock(map.mutex());
      a = copy_view(map, keyframe);
      b = copy_view(map, neighbour);
    }
    if (!a || !b) continue;
    const std::vector<NewPoint> found = find_new_points(rig, *a, *b);
    const std::unique_lock lock(map.mutex());
    for (const NewPoint& point : found) {
      const MapPointId id = map.add_point(point.position, {keyframe, point.in_a});
      if (!id.valid()) continue;
      if (map.add_observation(id, {neighbour, point.in_b})) {
        map.refresh_point(id);
        created.push_back(id);
      } else {
        map.erase_point(id);
      }
    }
  }
  return created;
}

}  // namespace cpslam
