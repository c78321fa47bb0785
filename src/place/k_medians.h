#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "features/descriptor.h"
#include "util/random.h"

namespace cpslam {

/// A partition of descriptors.
struct Clusters {
  std::vector<Descriptor> centres;  ///< all different and none without descriptors
  std::vector<std::size_t> starts;  ///< where each one's descriptors begin; one more entry at the end
};

/// Partitions descriptors into at most k clusters around their medians in Hamming space: k-means++ start
/// (Arthur and Vassilvitskii 2007), then Lloyd's iterations with majority votes, at most max_iterations.
/// Orders the descriptors by cluster, within one as they were. Every descriptor is in the cluster of the
/// nearest centre, the first of equals. Fewer than k clusters when there are fewer different descriptors;
/// descriptors must not be empty, k not 0.
[[nodiscard]] Clusters k_medians(std::span<Descriptor> descriptors, std::size_t k, int max_iterations,
                                 Random& random);

}  // namespace cpslam
