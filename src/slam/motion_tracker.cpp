#include "slam/motion_tracker.h"

#include "match/orb_matcher.h"
#include "slam/observation_model.h"
#include "slam/pose_refinement.h"

namespace cpslam {
namespace {

constexpr int kMinMatches = 20;  // before the optimisation; fewer ask for a wider window
constexpr int kMinInliers = 10;

/// Matches last's points into frame; returns how many.
int match_last_frame(const Rig& rig, const Frame& last, float radius_px, Frame& frame) {
  std::vector<ProjectionQuery> queries;
  std::vector<std::size_t> sources;
  for (std::size_t i = 0; i < last.matches.size(); ++i) {
    if (last.matches[i].kind == PointMatch::Kind::kNone) continue;
    const Eigen::Vector3d in_camera = frame.cam_from_world * last.matches[i].position_in_world;
    if (in_camera.z() <= 0.0) continue;
    const Eigen::Vector2d uv = rig.camera.project(in_camera);
    if (!rig.camera.in_image(uv)) continue;
    const Keypoint& seen = last.features->keypoints[i];
    ProjectionQuery query;
    query.uv = uv.cast<float>();
    query.disparity = static_cast<float>(rig.camera.bf() / in_camera.z());
    query.radius = radius_px * rig.pyramid.factor[static_cast<std::size_t>(seen.octave)];
    query.min_octave = seen.octave - 1;
    query.max_octave = seen.octave + 1;
    query.angle_deg = seen.angle_deg;
    query.descriptor = &last.features->descriptors[i];
    queries.push_back(query);
    sources.push_back(i);
  }
  MatchOptions options;
  options.check_rotation = true;
  options.ratio = 0.9F;
  const std::vector<int> found = match_by_projection(*frame.features, queries, {}, options);
  int n = 0;
  for (std::size_t q = 0; q < found.size(); ++q) {
    if (found[q] < 0) continue;
    frame.matches[static_cast<std::size_t>(found[q])] = last.matches[sources[q]];
    ++n;
  }
  return n;
}

}  // namespace

void add_temporary_points(const Rig& rig, Frame& frame) {
  const SE3 world_from_cam = frame.cam_from_world.inverse();
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    const double depth_m = frame.features->depth_m[i];
    if (frame.matches[i].kind != PointMatch::Kind::kNone || depth_m <= 0.0 || depth_m > rig.close_depth_m)
      continue;
    frame.matches[i] = {PointMatch::Kind::kTemporary, MapPointId{},
                        world_from_cam * back_project(rig, *frame.features, static_cast<int>(i))};
  }
}

void refresh_frame(const Map& map, const SE3& cam_from_world, Frame& frame) {
  const SE3 new_from_old = cam_from_world.inverse() * frame.cam_from_world;
  frame.cam_from_world = cam_from_world;
  for (PointMatch& match : frame.matches) {
    if (match.kind == PointMatch::Kind::kNone) continue;
    const MapPoint* point = match.kind == PointMatch::Kind::kMapPoint ? map.point(match.id) : nullptr;
    if (point == nullptr) match.kind = PointMatch::Kind::kTemporary;
    match.position_in_world =
        point != nullptr ? point->position_in_world : Eigen::Vector3d(new_from_old * match.position_in_world);
  }
}

int track_from_last_frame(const Rig& rig, const Frame& last, float radius_px, Frame& frame) {
  const SE3 predicted = frame.cam_from_world;
  frame.matches.assign(frame.matches.size(), PointMatch{});
  if (match_last_frame(rig, last, radius_px, frame) >= kMinMatches) {
    const RefinedPose refined = refine_pose(rig, frame);
    const int inliers = refined.map_points + refined.temporary_points;
    if (inliers >= kMinInliers) return inliers;
  }
  frame.cam_from_world = predicted;
  frame.matches.assign(frame.matches.size(), PointMatch{});
  return 0;
}

}  // namespace cpslam
