#include <algorithm>

#include "match/orb_matcher.h"
#include "slam/local_map.h"
#include "slam/pose_refinement.h"

namespace cpslam {
namespace {

constexpr float kFrontalWindowPx = 2.5F;
constexpr float kObliqueWindowPx = 4.0F;

/// Ids of the map points the frame is matched to, sorted; temporary matches are dropped on the way.
std::vector<MapPointId> drop_temporary(Frame& frame) {
  std::vector<MapPointId> ids;
  for (PointMatch& match : frame.matches) {
    if (match.kind == PointMatch::Kind::kTemporary) match = {};
    if (match.kind == PointMatch::Kind::kMapPoint) ids.push_back(match.id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

LocalMapMatch track_local_map(const Rig& rig, const LocalMap& local_map, float window, Frame& frame) {
  LocalMapMatch result;
  const std::vector<MapPointId> matched = drop_temporary(frame);
  result.expected = matched;
  const Eigen::Vector3d centre = frame.cam_from_world.inverse().translation;
  std::vector<ProjectionQuery> queries;
  std::vector<const PointSnapshot*> sources;
  const SearchWindow search{window * kFrontalWindowPx, window * kObliqueWindowPx};
  for (const PointSnapshot& point : local_map.points()) {
    if (std::binary_search(matched.begin(), matched.end(), point.id)) continue;
    const auto query = expect_point(rig, point, frame.cam_from_world, centre, search);
    if (!query) continue;
    queries.push_back(*query);
    sources.push_back(&point);
    result.expected.push_back(point.id);
  }
  std::vector<std::uint8_t> taken(frame.matches.size(), 0);
  for (std::size_t i = 0; i < taken.size(); ++i)
    taken[i] = frame.matches[i].kind == PointMatch::Kind::kNone ? 0 : 1;
  MatchOptions options;
  options.ratio = 0.8F;
  const std::vector<int> found = match_by_projection(*frame.features, queries, taken, options);
  for (std::size_t q = 0; q < found.size(); ++q) {
    if (found[q] < 0) continue;
    frame.matches[static_cast<std::size_t>(found[q])] = {PointMatch::Kind::kMapPoint, sources[q]->id,
                                                         sources[q]->position_in_world};
  }
  const RefinedPose refined = refine_pose(rig, frame);
  result.inliers = refined.map_points;
  result.covariance = refined.covariance;
  return result;
}

}  // namespace cpslam
