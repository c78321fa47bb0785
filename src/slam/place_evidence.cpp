#include "slam/place_evidence.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cpslam {
namespace {

constexpr float kNearPx = 25.0F;
constexpr float kBesidePx = 8.0F;
// Noise of the depth, error of the pose, and a keypoint that lies beside the point on a slanted surface.
constexpr double kToleranceM = 0.1;
constexpr double kRelativeTolerance = 0.03;
// docs/benchmarks.md, Places: right places balanced to 0.18 and more, mostly above 0.24, wrong ones to 0.19;
// but for some at the map's rim, which looked through more than right ones do where so little matches.
constexpr double kWeightOfSeenThrough = 2.0;
constexpr double kConvincing = 0.21;
constexpr double kMuchSeenThrough = 0.12;
constexpr double kPlentyMatched = 0.36;

enum class Depths : std::uint8_t { kNone, kAgree, kNearer, kFarther };

/// What the depths of these keypoints say of a point at z_m. One that agrees is enough: beside a rim lie both
/// surfaces.
Depths compare_depths(const FrameFeatures& features, const std::vector<int>& keypoints, double z_m) {
  Depths result = Depths::kNone;
  for (const int i : keypoints) {
    const double depth_m = static_cast<double>(features.depth_m[static_cast<std::size_t>(i)]);
    if (depth_m <= 0.0) continue;
    if (std::abs(depth_m - z_m) < kToleranceM + kRelativeTolerance * z_m) return Depths::kAgree;
    if (depth_m < z_m) {
      result = Depths::kNearer;
    } else if (result == Depths::kNone) {
      result = Depths::kFarther;
    }
  }
  return result;
}

bool is_beside(const FrameFeatures& features, int i, const Eigen::Vector2f& uv) {
  const Keypoint& keypoint = features.keypoints[static_cast<std::size_t>(i)];
  return std::abs(keypoint.x - uv.x()) <= kBesidePx && std::abs(keypoint.y - uv.y()) <= kBesidePx;
}

double share(std::ptrdiff_t part, std::ptrdiff_t rest) {
  return part == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(part + rest);
}

}  // namespace

bool PlaceEvidence::is_convincing() const {
  if (seen_through_share > kMuchSeenThrough && matched_share < kPlentyMatched) return false;
  return matched_share + found_share - kWeightOfSeenThrough * seen_through_share >= kConvincing;
}

PlaceEvidence place_evidence(const Rig& rig, const LocalMap& local_map, const Frame& frame) {
  const FrameFeatures& features = *frame.features;
  const Eigen::Vector3d centre = frame.cam_from_world.inverse().translation;
  std::vector<std::uint8_t> is_beside_point(static_cast<std::size_t>(features.size()), 0);
  std::vector<int> near;
  std::ptrdiff_t n_expected = 0, n_seen = 0, n_seen_through = 0;
  for (const PointSnapshot& point : local_map.points()) {
    const auto query = expect_point(rig, point, frame.cam_from_world, centre, {});
    if (!query) continue;
    near.clear();
    features.grid.query(query->uv.x(), query->uv.y(), kNearPx, 0, rig.pyramid.n_levels() - 1, near);
    if (near.empty()) continue;
    ++n_expected;
    std::erase_if(near, [&](int i) { return !is_beside(features, i, query->uv); });
    for (const int i : near) is_beside_point[static_cast<std::size_t>(i)] = 1;
    const Depths depths =
        compare_depths(features, near, (frame.cam_from_world * point.position_in_world).z());
    n_seen += depths == Depths::kAgree ? 1 : 0;
    n_seen_through += depths == Depths::kFarther ? 1 : 0;
  }
  std::ptrdiff_t n_matched = 0, n_unmatched = 0;
  for (std::size_t i = 0; i < is_beside_point.size(); ++i) {
    if (frame.matches[i].kind == PointMatch::Kind::kMapPoint) {
      ++n_matched;
    } else if (is_beside_point[i] != 0) {
      ++n_unmatched;
    }
  }
  // A found one that is not expected (at a bad angle, say) must not make more than all.
  const std::ptrdiff_t n_not_found = std::max<std::ptrdiff_t>(0, n_expected - n_matched);
  return {share(n_matched, n_unmatched), share(n_matched, n_not_found), share(n_seen_through, n_seen),
          n_expected};
}

}  // namespace cpslam
