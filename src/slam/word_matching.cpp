#include "slam/word_matching.h"

#include <algorithm>
#include <iterator>

namespace cpslam {
namespace {

std::vector<int> common(std::span<const int> of_node, std::span<const int> of_set) {
  std::vector<int> both;
  std::set_intersection(of_node.begin(), of_node.end(), of_set.begin(), of_set.end(),
                        std::back_inserter(both));
  return both;
}

}  // namespace

std::vector<KeypointMatch> match_by_words(const KeypointSet& a, const KeypointSet& b,
                                          const IndexPair& indices, const MatchOptions& options) {
  MatchOptions in_node = options;
  in_node.check_rotation = false;  // a node has too few for a majority
  std::vector<KeypointMatch> matches;
  for_each_common_node(indices.a, indices.b, [&](std::span<const int> node_a, std::span<const int> node_b) {
    const std::vector<int> from_a = common(node_a, a.indices);
    const std::vector<int> from_b = common(node_b, b.indices);
    const auto found = match_by_appearance({a.features, from_a}, {b.features, from_b}, in_node);
    matches.insert(matches.end(), found.begin(), found.end());
  });
  return options.check_rotation ? keep_majority_rotation(a.features, b.features, matches) : matches;
}

}  // namespace cpslam
