#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "features/descriptor.h"
#include "place/bow_vector.h"
#include "place/feature_vector.h"

namespace cpslam {

/// The tree of a vocabulary as flat arrays, nodes breadth first: node 0 is the root, and the children of a
/// node follow one another. That order is what makes it a tree: no list of children can name a node twice,
/// point back or leave one out.
struct VocabularyTree {
  std::uint32_t branching = 0;             ///< most children a node may have, k
  std::uint32_t depth = 0;                 ///< most levels below the root, L
  std::vector<Descriptor> descriptors;     ///< of each node; the root's means nothing
  std::vector<std::uint32_t> first_child;  ///< children of i: first_child[i] to first_child[i + 1] - 1
  std::vector<float> word_weights;         ///< of the leaves in their order: inverse document frequency
};

/// What a vocabulary says about an image.
struct ImageWords {
  BowVector bow;
  FeatureVector features;
};

/// Hierarchical vocabulary of binary descriptors (Nister and Stewenius 2006; binary: Galvez-Lopez and Tardos
/// 2012). Immutable: a const one may be used by several threads.
class Vocabulary {
 public:
  static constexpr std::uint32_t kMaxBranching = 256;
  static constexpr std::uint32_t kMaxDepth = 16;
  /// Depth of the direct index that transform() makes unless told otherwise: with ten branches a hundred
  /// nodes, about ten features of an image each.
  static constexpr std::uint32_t kIndexDepth = 2;

  /// Throws InputError that says what is wrong with a tree that is none: sizes that do not go together,
  /// children out of order, more of them or deeper than promised, weights that are negative or not finite.
  explicit Vocabulary(VocabularyTree tree);

  /// Words by term frequency times inverse document frequency, normalised to a sum of 1, and the direct index
  /// at index_depth (a leaf further up stands for itself). Words that say nothing (weight 0) are left out of
  /// the bag, not of the index.
  [[nodiscard]] ImageWords transform(std::span<const Descriptor> descriptors,
                                     std::uint32_t index_depth = kIndexDepth) const;

  /// The word of one descriptor: down the tree along the nearest child, the first of equals.
  [[nodiscard]] WordId word(const Descriptor& descriptor) const;

  [[nodiscard]] std::size_t n_words() const { return tree_.word_weights.size(); }
  [[nodiscard]] std::size_t n_nodes() const { return tree_.descriptors.size(); }
  [[nodiscard]] const VocabularyTree& tree() const { return tree_; }

  /// Hash of the whole content: what was computed with one vocabulary means nothing to another.
  [[nodiscard]] std::uint64_t identity() const { return identity_; }

 private:
  struct Leaf {
    NodeId node = 0;
    NodeId at_index_depth = 0;
  };
  [[nodiscard]] Leaf descend(const Descriptor& descriptor, std::uint32_t index_depth) const;

  VocabularyTree tree_;
  std::vector<WordId> words_;  // of each node; means something for leaves
  std::uint64_t identity_ = 0;
};

}  // namespace cpslam
