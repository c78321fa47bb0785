#include <cmath>
#include <limits>

#include "match/orb_matcher.h"
#include "match/rotation_check.h"

namespace cpslam {
namespace {

struct Best {
  int keypoint = -1;
  int distance = std::numeric_limits<int>::max();
};

/// Most alike keypoint among the candidates, or -1 when the second best of its octave is about as good.
Best most_alike(const FrameFeatures& frame, const ProjectionQuery& query, std::span<const int> candidates,
                std::span<const std::uint8_t> taken, const MatchOptions& options) {
  Best best;
  Best second;
  for (const int candidate : candidates) {
    const auto i = static_cast<std::size_t>(candidate);
    if (!taken.empty() && taken[i] != 0) continue;
    if (query.disparity > 0.0F && frame.disparity_px[i] > 0.0F &&
        std::abs(frame.disparity_px[i] - query.disparity) > query.radius) {
      continue;
    }
    const int distance = descriptor_distance(*query.descriptor, frame.descriptors[i]);
    if (distance < best.distance) {
      second = best;
      best = {candidate, distance};
    } else if (distance < second.distance) {
      second = {candidate, distance};
    }
  }
  if (best.keypoint < 0 || best.distance > options.max_distance) return {};
  // Neighbouring octaves see the same corner, so only a rival of the same octave makes a match ambiguous.
  const bool rival =
      second.keypoint >= 0 && frame.keypoints[static_cast<std::size_t>(second.keypoint)].octave ==
                                  frame.keypoints[static_cast<std::size_t>(best.keypoint)].octave;
  if (rival && static_cast<float>(best.distance) > options.ratio * static_cast<float>(second.distance))
    return {};
  return best;
}

void drop_rotated(const FrameFeatures& frame, std::span<const ProjectionQuery> queries,
                  std::vector<int>& matches) {
  std::vector<float> differences;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    if (matches[q] < 0) continue;
    differences.push_back(queries[q].angle_deg -
                          frame.keypoints[static_cast<std::size_t>(matches[q])].angle_deg);
  }
  const std::vector<bool> agrees = agrees_with_majority(differences);
  std::size_t next = 0;
  for (int& match : matches) {
    if (match >= 0 && !agrees[next++]) match = -1;
  }
}

}  // namespace

std::vector<int> match_by_projection(const FrameFeatures& frame, std::span<const ProjectionQuery> queries,
                                     std::span<const std::uint8_t> taken, const MatchOptions& options) {
  std::vector<int> matches(queries.size(), -1);
  std::vector<Best> owner(static_cast<std::size_t>(frame.size()));  // keypoint -> best query so far
  std::vector<int> candidates;
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const ProjectionQuery& query = queries[q];
    candidates.clear();
    frame.grid.query(query.uv.x(), query.uv.y(), query.radius, query.min_octave, query.max_octave,
                     candidates);
    const Best best = most_alike(frame, query, candidates, taken, options);
    if (best.keypoint < 0) continue;
    Best& current = owner[static_cast<std::size_t>(best.keypoint)];
    if (best.distance >= current.distance) continue;
    if (current.keypoint >= 0) matches[static_cast<std::size_t>(current.keypoint)] = -1;
    current = {static_cast<int>(q), best.distance};
    matches[q] = best.keypoint;
  }
  if (options.check_rotation) drop_rotated(frame, queries, matches);
  return matches;
}

}  // namespace cpslam
