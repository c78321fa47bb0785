#include "place/vocabulary.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cpslam/error.h"
#include "util/hash.h"

namespace cpslam {
namespace {

constexpr std::size_t kMaxNodes = std::size_t{1} << 28U;

void require(bool holds, const std::string& what) {
  if (!holds) throw InputError("this is no vocabulary: " + what);
}

void check_sizes(const VocabularyTree& tree) {
  require(tree.branching >= 2 && tree.branching <= Vocabulary::kMaxBranching,
          "it has " + std::to_string(tree.branching) + " branches a node, 2 to " +
              std::to_string(Vocabulary::kMaxBranching) + " are possible");
  require(tree.depth >= 1 && tree.depth <= Vocabulary::kMaxDepth,
          "it has " + std::to_string(tree.depth) + " levels, 1 to " + std::to_string(Vocabulary::kMaxDepth) +
              " are possible");
  require(tree.descriptors.size() >= 2 && tree.descriptors.size() <= kMaxNodes,
          "it has " + std::to_string(tree.descriptors.size()) + " nodes");
  require(tree.first_child.size() == tree.descriptors.size() + 1,
          "nodes and lists of children differ in number");
}

void check_children(const VocabularyTree& tree) {
  const std::size_t n = tree.descriptors.size();
  require(tree.first_child.front() == 1 && tree.first_child.back() == n, "some nodes are nobody's children");
  for (std::size_t i = 0; i < n; ++i) {
    const auto node = [i] { return "node " + std::to_string(i); };
    require(tree.first_child[i] > i && tree.first_child[i] <= tree.first_child[i + 1],
            node() + " has its children out of order");
    require(tree.first_child[i + 1] - tree.first_child[i] <= tree.branching,
            node() + " has too many children");
  }
  std::uint32_t depth = 0;
  for (std::size_t level_end = 1; level_end < n; ++depth) {
    require(depth < tree.depth,
            "it is deeper than the " + std::to_string(tree.depth) + " levels it promises");
    level_end = tree.first_child[level_end];
  }
}

std::vector<WordId> number_words(const VocabularyTree& tree) {
  std::vector<WordId> words(tree.descriptors.size());
  WordId next = 0;
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = next;
    if (tree.first_child[i] == tree.first_child[i + 1]) ++next;
  }
  require(next == tree.word_weights.size(), "it has " + std::to_string(next) + " words, but weights for " +
                                                std::to_string(tree.word_weights.size()));
  return words;
}

std::uint64_t hash(const VocabularyTree& tree) {
  Hash hash;
  hash.add_word(tree.branching);
  hash.add_word(tree.depth);
  hash.add_elements(std::span<const Descriptor>(tree.descriptors).subspan(1));
  hash.add_elements(std::span<const std::uint32_t>(tree.first_child));
  hash.add_elements(std::span<const float>(tree.word_weights));
  return hash.value();
}

}  // namespace

Vocabulary::Vocabulary(VocabularyTree tree) : tree_(std::move(tree)) {
  check_sizes(tree_);
  check_children(tree_);
  words_ = number_words(tree_);
  for (const float weight : tree_.word_weights) {
    require(std::isfinite(weight) && weight >= 0.0F, "a weight is negative or no number");
  }
  identity_ = hash(tree_);
}

Vocabulary::Leaf Vocabulary::descend(const Descriptor& descriptor, std::uint32_t index_depth) const {
  Leaf leaf;
  for (std::uint32_t depth = 0;; ++depth) {
    if (depth <= index_depth) leaf.at_index_depth = leaf.node;
    const std::uint32_t begin = tree_.first_child[leaf.node];
    const std::uint32_t end = tree_.first_child[leaf.node + 1];
    if (begin == end) return leaf;
    leaf.node = begin;
    int nearest = descriptor_distance(descriptor, tree_.descriptors[begin]);
    for (std::uint32_t child = begin + 1; child < end; ++child) {
      const int distance = descriptor_distance(descriptor, tree_.descriptors[child]);
      if (distance >= nearest) continue;
      nearest = distance;
      leaf.node = child;
    }
  }
}

WordId Vocabulary::word(const Descriptor& descriptor) const {
  return words_[descend(descriptor, 0).node];
}

ImageWords Vocabulary::transform(std::span<const Descriptor> descriptors, std::uint32_t index_depth) const {
  std::vector<NodeId> nodes;
  nodes.reserve(descriptors.size());
  std::vector<WordId> found;
  found.reserve(descriptors.size());
  for (const Descriptor& descriptor : descriptors) {
    const Leaf leaf = descend(descriptor, index_depth);
    nodes.push_back(leaf.at_index_depth);
    const WordId word = words_[leaf.node];
    if (tree_.word_weights[word] > 0.0F) found.push_back(word);
  }
  std::sort(found.begin(), found.end());

  ImageWords image;
  image.features = FeatureVector(nodes);
  double sum = 0.0;
  for (const WordId word : found) {
    const float weight = tree_.word_weights[word];
    sum += static_cast<double>(weight);
    if (image.bow.empty() || image.bow.back().word != word) {
      image.bow.push_back({word, weight});
    } else {
      image.bow.back().weight += weight;
    }
  }
  for (WordWeight& word : image.bow) {
    word.weight = static_cast<float>(static_cast<double>(word.weight) / sum);
  }
  return image;
}

}  // namespace cpslam
