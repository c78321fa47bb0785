#include "slam/found_share.h"

#include <algorithm>
#include <vector>

namespace cpslam {
namespace {

constexpr float kNearPx = 25.0F;

}  // namespace

double found_share(const Rig& rig, const LocalMap& local_map, const Frame& frame) {
  const auto found = std::count_if(frame.matches.begin(), frame.matches.end(), [](const PointMatch& match) {
    return match.kind == PointMatch::Kind::kMapPoint;
  });
  const Eigen::Vector3d centre = frame.cam_from_world.inverse().translation;
  std::vector<int> near;
  std::ptrdiff_t expected = 0;
  for (const PointSnapshot& point : local_map.points()) {
    const auto query = expect_point(rig, point, frame.cam_from_world, centre, {});
    if (!query) continue;
    near.clear();
    frame.features->grid.query(query->uv.x(), query->uv.y(), kNearPx, 0, rig.pyramid.n_levels() - 1, near);
    if (!near.empty()) ++expected;
  }
  // A found one that is not expected (at a bad angle, say) must not make more than all.
  return found == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(std::max(found, expected));
}

}  // namespace cpslam
