#include "place/feature_vector.h"

#include <algorithm>
#include <numeric>

namespace cpslam {

FeatureVector::FeatureVector(std::span<const NodeId> nodes) : features_(nodes.size()) {
  std::iota(features_.begin(), features_.end(), 0);
  const auto node_of = [&](int feature) { return nodes[static_cast<std::size_t>(feature)]; };
  std::stable_sort(features_.begin(), features_.end(), [&](int a, int b) { return node_of(a) < node_of(b); });
  for (std::size_t i = 0; i < features_.size(); ++i) {
    if (!nodes_.empty() && nodes_.back() == node_of(features_[i])) continue;
    nodes_.push_back(node_of(features_[i]));
    starts_.push_back(i);
  }
  starts_.push_back(features_.size());
}

}  // namespace cpslam
