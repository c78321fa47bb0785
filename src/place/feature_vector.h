#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cpslam {

using NodeId = std::uint32_t;

/// Direct index of an image (Galvez-Lopez and Tardos 2012): which of its features lie under which node of the
/// vocabulary at one depth. Features that look alike mostly lie under the same node, so that two images can
/// be matched node by node instead of every feature against every other. Plain data: a const one may be read
/// from several threads.
class FeatureVector {
 public:
  /// A node and its features' indices, ascending.
  struct Entry {
    NodeId node = 0;
    std::span<const int> features;
  };

  FeatureVector() = default;
  /// nodes[i]: the node of feature i.
  explicit FeatureVector(std::span<const NodeId> nodes);

  /// By ascending node; the spans last as long as this object does.
  [[nodiscard]] Entry entry(std::size_t i) const {
    return {nodes_[i], std::span(features_).subspan(starts_[i], starts_[i + 1] - starts_[i])};
  }
  /// Number of different nodes.
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<NodeId> nodes_;
  std::vector<std::size_t> starts_;  // of nodes_[i] in features_; one more at the end
  std::vector<int> features_;
};

/// Calls visit(span<const int> features_of_a, span<const int> features_of_b) for every node that both images
/// have, by ascending node. Both come from the same vocabulary and depth.
template <class Visit>
void for_each_common_node(const FeatureVector& a, const FeatureVector& b, Visit visit) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const FeatureVector::Entry in_a = a.entry(i);
    const FeatureVector::Entry in_b = b.entry(j);
    if (in_a.node == in_b.node) visit(in_a.features, in_b.features);
    if (in_a.node <= in_b.node) ++i;
    if (in_b.node <= in_a.node) ++j;
  }
}

}  // namespace cpslam
