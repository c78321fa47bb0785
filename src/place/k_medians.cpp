#include "place/k_medians.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "place/bit_votes.h"

namespace cpslam {
namespace {

/// Start centres: each next one drawn with a probability that grows with the square of its distance to those
/// there are.
std::vector<Descriptor> draw_centres(std::span<const Descriptor> descriptors, std::size_t k, Random& random) {
  std::vector<Descriptor> centres{descriptors[random.index(descriptors.size())]};
  std::vector<int> nearest(descriptors.size(), std::numeric_limits<int>::max());
  std::vector<double> cumulative(descriptors.size());
  while (centres.size() < k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      nearest[i] = std::min(nearest[i], descriptor_distance(descriptors[i], centres.back()));
      sum += static_cast<double>(nearest[i]) * nearest[i];
      cumulative[i] = sum;
    }
    if (sum <= 0.0) break;  // every descriptor is a centre
    const auto drawn = std::upper_bound(cumulative.begin(), cumulative.end() - 1, random.uniform() * sum);
    centres.push_back(descriptors[static_cast<std::size_t>(drawn - cumulative.begin())]);
  }
  return centres;
}

std::size_t nearest_centre(const Descriptor& descriptor, std::span<const Descriptor> centres) {
  std::size_t nearest = 0;
  int least = std::numeric_limits<int>::max();
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const int distance = descriptor_distance(descriptor, centres[c]);
    if (distance >= least) continue;
    least = distance;
    nearest = c;
  }
  return nearest;
}

/// Gives every descriptor its nearest centre; true when that changed anything.
bool assign(std::span<const Descriptor> descriptors, std::span<const Descriptor> centres,
            std::vector<std::size_t>& cluster_of) {
  bool changed = false;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const std::size_t nearest = nearest_centre(descriptors[i], centres);
    changed = changed || nearest != cluster_of[i];
    cluster_of[i] = nearest;
  }
  return changed;
}

void move_to_medians(std::span<const Descriptor> descriptors, std::span<const std::size_t> cluster_of,
                     std::vector<Descriptor>& centres) {
  std::vector<BitVotes> votes(centres.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) votes[cluster_of[i]].add(descriptors[i]);
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (votes[c].size() > 0) centres[c] = votes[c].majority(centres[c]);
  }
}

Clusters sort_into_clusters(std::span<Descriptor> descriptors, std::span<const std::size_t> cluster_of,
                            std::span<const Descriptor> centres) {
  std::vector<std::size_t> ends(centres.size() + 1, 0);
  for (const std::size_t c : cluster_of) ++ends[c + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  Clusters clusters;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (ends[c] == ends[c + 1]) continue;
    clusters.centres.push_back(centres[c]);
    clusters.starts.push_back(ends[c]);
  }
  clusters.starts.push_back(descriptors.size());
  const std::vector<Descriptor> unsorted(descriptors.begin(), descriptors.end());
  for (std::size_t i = 0; i < unsorted.size(); ++i) descriptors[ends[cluster_of[i]]++] = unsorted[i];
  return clusters;
}

}  // namespace

Clusters k_medians(std::span<Descriptor> descriptors, std::size_t k, int max_iterations, Random& random) {
  std::vector<Descriptor> centres = draw_centres(descriptors, k, random);
  std::vector<std::size_t> cluster_of(descriptors.size(), 0);
  assign(descriptors, centres, cluster_of);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    move_to_medians(descriptors, cluster_of, centres);
    if (!assign(descriptors, centres, cluster_of)) break;
  }
  return sort_into_clusters(descriptors, cluster_of, centres);
}

}  // namespace cpslam
