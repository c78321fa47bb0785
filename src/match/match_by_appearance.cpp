#include <limits>

#include "match/orb_matcher.h"
#include "match/rotation_check.h"

namespace cpslam {
namespace {

constexpr int kWorst = std::numeric_limits<int>::max();

struct Nearest {
  int index = -1;  // position in the other set's indices
  int distance = kWorst;
  int second_distance = kWorst;
};

void offer(Nearest& nearest, int index, int distance) {
  if (distance < nearest.distance) {
    nearest.second_distance = nearest.distance;
    nearest.distance = distance;
    nearest.index = index;
  } else if (distance < nearest.second_distance) {
    nearest.second_distance = distance;
  }
}

bool distinct(const Nearest& nearest, const MatchOptions& options) {
  return nearest.index >= 0 && nearest.distance <= options.max_distance &&
         (nearest.second_distance == kWorst ||
          static_cast<float>(nearest.distance) <=
              options.ratio * static_cast<float>(nearest.second_distance));
}

}  // namespace

std::vector<KeypointMatch> match_by_appearance(const KeypointSet& a, const KeypointSet& b,
                                               const MatchOptions& options) {
  std::vector<Nearest> of_a(a.indices.size());
  std::vector<Nearest> of_b(b.indices.size());
  for (std::size_t i = 0; i < a.indices.size(); ++i) {
    const Descriptor& descriptor = a.features.descriptors[static_cast<std::size_t>(a.indices[i])];
    for (std::size_t j = 0; j < b.indices.size(); ++j) {
      const int distance =
          descriptor_distance(descriptor, b.features.descriptors[static_cast<std::size_t>(b.indices[j])]);
      offer(of_a[i], static_cast<int>(j), distance);
      offer(of_b[j], static_cast<int>(i), distance);
    }
  }
  std::vector<KeypointMatch> matches;
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!distinct(of_a[i], options)) continue;
    const auto j = static_cast<std::size_t>(of_a[i].index);
    if (of_b[j].index == static_cast<int>(i)) matches.push_back({a.indices[i], b.indices[j]});
  }
  return options.check_rotation ? keep_majority_rotation(a.features, b.features, matches) : matches;
}

std::vector<KeypointMatch> match_by_epipolar_line(const KeypointSet& a, const KeypointSet& b,
                                                  const EpipolarGeometry& geometry,
                                                  const ScalePyramid& pyramid, const MatchOptions& options) {
  constexpr double kChi2Line = 3.841;           // 95 % for one degree of freedom
  constexpr double kMinEpipoleDistance = 10.0;  // px at level 0
  std::vector<KeypointMatch> matches;
  std::vector<int> owner_distance(static_cast<std::size_t>(b.features.size()), kWorst);
  std::vector<int> owner(static_cast<std::size_t>(b.features.size()), -1);
  for (const int index_a : a.indices) {
    const auto i = static_cast<std::size_t>(index_a);
    const Keypoint& in_a = a.features.keypoints[i];
    const Eigen::Vector3d line = geometry.fundamental_ba * Eigen::Vector3d(in_a.x, in_a.y, 1.0);
    const double line_norm2 = line.head<2>().squaredNorm();
    if (line_norm2 <= 0.0) continue;
    int best = -1;
    int best_distance = options.max_distance + 1;
    for (const int index_b : b.indices) {
      const auto j = static_cast<std::size_t>(index_b);
      const Keypoint& in_b = b.features.keypoints[j];
      const double scale = pyramid.factor[static_cast<std::size_t>(in_b.octave)];
      const double offset = line.x() * in_b.x + line.y() * in_b.y + line.z();
      if (offset * offset > kChi2Line * scale * scale * line_norm2) continue;
      const bool has_depth = a.features.depth_m[i] > 0.0F || b.features.depth_m[j] > 0.0F;
      const Eigen::Vector2d from_epipole = Eigen::Vector2d(in_b.x, in_b.y) - geometry.epipole_in_b;
      if (!has_depth && from_epipole.norm() < kMinEpipoleDistance * scale) continue;
      const int distance = descriptor_distance(a.features.descriptors[i], b.features.descriptors[j]);
      if (distance < best_distance) {
        best_distance = distance;
        best = index_b;
      }
    }
    if (best < 0 || best_distance >= owner_distance[static_cast<std::size_t>(best)]) continue;
    owner_distance[static_cast<std::size_t>(best)] = best_distance;
    owner[static_cast<std::size_t>(best)] = index_a;
  }
  for (const int index_b : b.indices) {
    if (const int index_a = owner[static_cast<std::size_t>(index_b)]; index_a >= 0) {
      matches.push_back({index_a, index_b});
    }
  }
  return options.check_rotation ? keep_majority_rotation(a.features, b.features, matches) : matches;
}

std::vector<KeypointMatch> keep_majority_rotation(const FrameFeatures& a, const FrameFeatures& b,
                                                  const std::vector<KeypointMatch>& matches) {
  std::vector<float> differences;
  differences.reserve(matches.size());
  for (const KeypointMatch& match : matches) {
    differences.push_back(a.keypoints[static_cast<std::size_t>(match.a)].angle_deg -
                          b.keypoints[static_cast<std::size_t>(match.b)].angle_deg);
  }
  const std::vector<bool> agrees = agrees_with_majority(differences);
  std::vector<KeypointMatch> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (agrees[i]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace cpslam
