#pragma once

#include <vector>

#include "match/orb_matcher.h"
#include "place/feature_vector.h"

namespace cpslam {

/// Direct indices of two images, of the same vocabulary and depth.
struct IndexPair {
  const FeatureVector& a;
  const FeatureVector& b;
};

/// match_by_appearance() among those keypoints only that lie under the same node of the vocabulary
/// (Galvez-Lopez and Tardos 2012): a hundredth of the comparisons, and not all of the pairs. The indices of
/// both sets must ascend.
[[nodiscard]] std::vector<KeypointMatch> match_by_words(const KeypointSet& a, const KeypointSet& b,
                                                        const IndexPair& indices,
                                                        const MatchOptions& options);

}  // namespace cpslam
