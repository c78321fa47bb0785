#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "place/vocabulary_training.h"
#include "slam/essential_graph.h"
#include "slam/places.h"
#include "slam/scene.h"

/// A round walk whose end odometry has somewhere else than its start.
namespace cpslam::scene {

/// Points all round the origin, each with a look of its own.
inline synthetic::World round_world(std::size_t n_points, Random& random) {
  synthetic::World world;
  for (std::size_t i = 0; i < n_points; ++i) {
    const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double distance_m = random.uniform(1.8, 3.2);
    world.points.emplace_back(distance_m * std::sin(azimuth), random.uniform(-1.2, 1.2),
                              distance_m * std::cos(azimuth));
    world.descriptors.push_back(synthetic::random_descriptor(random));
    world.reference_distance_m.push_back(world.points.back().norm());
  }
  return world;
}

/// Turned by `azimuth` about the vertical, 0.3 m from the origin towards where it looks.
inline SE3 outward_pose(double azimuth) {
  return SE3(so3_exp({0.0, -azimuth, 0.0}), {0.0, 0.0, -0.3});
}

struct RoundOptions {
  int keyframes = 26;
  double step_rad = 2.0 * std::numbers::pi / 24.0;  ///< so the last two stand where the first two stood
  double drift_m = 0.005;  ///< downwards, a keyframe: sideways it would only widen the round
  double drift_rad = 0.004;
  std::size_t points = 2500;
  std::uint64_t seed = 41;
};

/// The map of a round walk without loop closing: a point that has been out of sight is made anew. Poses and
/// points agree with the drifted odometry.
struct RoundWalk {
  explicit RoundWalk(const RoundOptions& o = {})
      : options(o), random(o.seed), world(round_world(o.points, random)) {
    id_of.resize(world.points.size());
    last_seen.assign(world.points.size(), -100);
    for (int i = 0; i < options.keyframes; ++i) add_keyframe_at(options.step_rad * i);
  }

  void add_keyframe_at(double azimuth) {
    const int i = static_cast<int>(keyframes.size());
    views.push_back(
        synthetic::look(world, outward_pose(azimuth), {.noise_px = 0.2, .bit_flips = 10}, random));
    Eigen::Matrix<double, 6, 1> drift;
    drift << 0.0, options.drift_m, 0.0, 0.0, options.drift_rad, 0.0;
    const SE3 mapped = i == 0 ? views[0].cam_from_world
                              : SE3::exp(drift) * views.back().cam_from_world *
                                    views[views.size() - 2].cam_from_world.inverse() *
                                    map.keyframe(keyframes.back())->cam_from_world;
    KeyFrame keyframe;
    keyframe.time_s = 0.5 * i;
    keyframe.features = views.back().features;
    keyframe.cam_from_world = mapped;
    keyframes.push_back(map.add_keyframe(std::move(keyframe)));
    link_points(i, mapped);
    map.update_covisibility(keyframes.back());
  }

  /// Where the keyframe lies in the map against where it should, seen from the first one, m and rad together.
  [[nodiscard]] double pose_error(std::size_t i) const {
    return synthetic::distance(map.keyframe(keyframes[i])->cam_from_world, views[i].cam_from_world);
  }
  [[nodiscard]] LoopEdge true_edge(std::size_t current, std::size_t matched) const {
    return {keyframes[current], keyframes[matched],
            views[current].cam_from_world * views[matched].cam_from_world.inverse()};
  }

  RoundOptions options;
  Random random;
  synthetic::World world;
  std::vector<synthetic::View> views;
  Map map{kRig.pyramid};
  std::vector<KeyFrameId> keyframes;  ///< parallel to views
  std::vector<MapPointId> id_of;      ///< latest point of the map for each of the world's
  std::vector<int> last_seen;

 private:
  void link_points(int i, const SE3& mapped) {
    const synthetic::View& view = views.back();
    const SE3 world_from_true = mapped.inverse() * view.cam_from_world;
    for (std::size_t p = 0; p < world.points.size(); ++p) {
      if (view.keypoint_of[p] < 0) continue;
      const Observation seen{keyframes.back(), view.keypoint_of[p]};
      if (i - last_seen[p] > 3) {
        id_of[p] = map.add_point(world_from_true * world.points[p], seen);
      } else {
        map.add_observation(id_of[p], seen);
        map.refresh_point(id_of[p]);
      }
      last_seen[p] = i;
    }
  }
};

/// A small vocabulary of the looks of a walk, with all its keyframes in the database.
inline std::unique_ptr<Places> places_of(const RoundWalk& walk) {
  std::vector<ImageDescriptors> images;
  for (const synthetic::View& view : walk.views) images.push_back(view.features->descriptors);
  VocabularyTrainingOptions options;
  options.branching = 8;
  options.depth = 3;
  return std::make_unique<Places>(train_vocabulary(images, options));
}

}  // namespace cpslam::scene
