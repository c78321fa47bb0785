#include "slam/local_bundle.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <shared_mutex>

#include "optim/bundle_adjuster.h"
#include "slam/observation_model.h"

namespace cpslam {
namespace {

constexpr std::size_t kMaxFreeKeyframes = 20;
constexpr std::size_t kMaxFixedKeyframes = 25;

/// The snapshot with the ids that lead back into the map.
struct LocalBundle {
  BundleProblem problem;
  std::vector<KeyFrameId> keyframes;  // parallel to problem.cam_from_world
  std::vector<MapPointId> points;     // parallel to problem.point_in_world
  bool solvable = false;
};

class Builder {
 public:
  Builder(const Rig& rig, const Map& map) : rig_(rig), map_(map) {
    bundle_.problem.camera = rig.reprojection;
  }

  LocalBundle build(KeyFrameId centre) {
    if (map_.keyframe(centre) == nullptr) return std::move(bundle_);
    add_keyframe(centre, false);
    for (const KeyFrameId id : map_.best_covisible(centre, kMaxFreeKeyframes - 1)) add_keyframe(id, false);
    add_points();
    add_fixed_keyframes();
    add_observations();
    hold_gauge();
    return std::move(bundle_);
  }

 private:
  void add_keyframe(KeyFrameId id, bool fixed) {
    pose_index_.emplace(id, static_cast<int>(bundle_.keyframes.size()));
    bundle_.keyframes.push_back(id);
    bundle_.problem.cam_from_world.push_back(map_.keyframe(id)->cam_from_world);
    bundle_.problem.pose_fixed.push_back(fixed ? 1 : 0);
  }

  void add_points() {
    for (const KeyFrameId id : bundle_.keyframes) {
      for (const MapPointId point : map_.keyframe(id)->points) {
        if (point.valid()) bundle_.points.push_back(point);
      }
    }
    std::sort(bundle_.points.begin(), bundle_.points.end());
    bundle_.points.erase(std::unique(bundle_.points.begin(), bundle_.points.end()), bundle_.points.end());
    for (const MapPointId id : bundle_.points) {
      bundle_.problem.point_in_world.push_back(map_.point(id)->position_in_world);
    }
  }

  /// The keyframes outside that see most of the points; more of them hold the gauge no better.
  void add_fixed_keyframes() {
    std::map<KeyFrameId, int> seen_points;
    for (const MapPointId id : bundle_.points) {
      for (const Observation& seen : map_.point(id)->observations) {
        if (!pose_index_.contains(seen.keyframe)) ++seen_points[seen.keyframe];
      }
    }
    std::vector<std::pair<int, KeyFrameId>> order;
    order.reserve(seen_points.size());
    for (const auto& [id, n] : seen_points) order.emplace_back(-n, id);
    std::sort(order.begin(), order.end());
    if (order.size() > kMaxFixedKeyframes) order.resize(kMaxFixedKeyframes);
    for (const auto& [n, id] : order) add_keyframe(id, true);
  }

  void add_observations() {
    for (std::size_t p = 0; p < bundle_.points.size(); ++p) {
      for (const Observation& seen : map_.point(bundle_.points[p])->observations) {
        const auto pose = pose_index_.find(seen.keyframe);
        if (pose == pose_index_.end()) continue;
        bundle_.problem.observations.push_back(
            {pose->second, static_cast<int>(p),
             observe(rig_, *map_.keyframe(seen.keyframe)->features, seen.keypoint)});
      }
    }
  }

  /// A young map has no keyframe outside: then its oldest one stays where it is.
  void hold_gauge() {
    auto& fixed = bundle_.problem.pose_fixed;
    const auto oldest = std::min_element(bundle_.keyframes.begin(), bundle_.keyframes.end(),
                                         [this](KeyFrameId a, KeyFrameId b) {
                                           return map_.keyframe(a)->sequence < map_.keyframe(b)->sequence;
                                         });
    const auto index = static_cast<std::size_t>(oldest - bundle_.keyframes.begin());
    if (map_.keyframe(*oldest)->sequence == 0 || std::find(fixed.begin(), fixed.end(), 1) == fixed.end()) {
      fixed[index] = 1;
    }
    bundle_.solvable = std::find(fixed.begin(), fixed.end(), 0) != fixed.end();
  }

  const Rig& rig_;
  const Map& map_;
  LocalBundle bundle_;
  std::map<KeyFrameId, int> pose_index_;
};

void write_back(Map& map, const LocalBundle& bundle, const BundleResult& result) {
  const BundleProblem& problem = bundle.problem;
  for (std::size_t o = 0; o < problem.observations.size(); ++o) {
    if (result.outlier[o] == 0) continue;
    const BundleProblem::Observation& seen = problem.observations[o];
    map.erase_observation(bundle.points[static_cast<std::size_t>(seen.point)],
                          bundle.keyframes[static_cast<std::size_t>(seen.pose)]);
  }
  for (std::size_t k = 0; k < bundle.keyframes.size(); ++k) {
    if (problem.pose_fixed[k] == 0) map.set_pose(bundle.keyframes[k], problem.cam_from_world[k]);
  }
  for (std::size_t p = 0; p < bundle.points.size(); ++p) {
    map.set_position(bundle.points[p], problem.point_in_world[p]);
    map.refresh_point(bundle.points[p]);
  }
}

}  // namespace

void adjust_local_bundle(const Rig& rig, Map& map, KeyFrameId keyframe, const std::atomic<bool>& abort) {
  LocalBundle bundle;
  {
    const std::shared_lock lock(map.mutex());
    bundle = Builder(rig, map).build(keyframe);
  }
  if (!bundle.solvable || bundle.problem.observations.empty()) return;
  BundleOptions options;
  options.final_iterations = rig.settings.mapping.local_ba_iterations;
  options.abort = &abort;
  const BundleResult result = adjust_bundle(bundle.problem, options);
  const std::unique_lock lock(map.mutex());
  write_back(map, bundle, result);
}

}  // namespace cpslam
