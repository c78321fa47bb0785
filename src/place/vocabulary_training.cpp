#include "place/vocabulary_training.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "cpslam/error.h"
#include "place/k_medians.h"
#include "util/random.h"

namespace cpslam {
namespace {

void check(const VocabularyTrainingOptions& options) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw InputError("cannot train a vocabulary " + what);
  };
  require(options.branching >= 2 && options.branching <= Vocabulary::kMaxBranching,
          "of " + std::to_string(options.branching) + " branches a node: give 2 to " +
              std::to_string(Vocabulary::kMaxBranching));
  require(
      options.depth >= 1 && options.depth <= Vocabulary::kMaxDepth,
      "of " + std::to_string(options.depth) + " levels: give 1 to " + std::to_string(Vocabulary::kMaxDepth));
}

/// At most max_features of all descriptors, chosen at random, in a random order.
std::vector<Descriptor> choose_features(std::span<const ImageDescriptors> images, std::size_t max_features,
                                        Random& random) {
  std::vector<Descriptor> all;
  for (const ImageDescriptors& image : images) all.insert(all.end(), image.begin(), image.end());
  const std::size_t wanted = std::min(max_features, all.size());
  for (std::size_t i = 0; i < wanted; ++i) std::swap(all[i], all[i + random.index(all.size() - i)]);
  all.resize(wanted);
  return all;
}

/// Descriptors of a node that may still be parted.
struct OpenNode {
  std::span<Descriptor> descriptors;
  std::uint32_t depth = 0;
};

class TreeGrower {
 public:
  TreeGrower(const VocabularyTrainingOptions& options, Random& random) : options_(options), random_(random) {}

  VocabularyTree grow(std::span<Descriptor> descriptors) {
    tree_.branching = options_.branching;
    tree_.depth = options_.depth;
    tree_.descriptors.push_back({});
    nodes_.push_back({descriptors, 0});
    const double all = static_cast<double>(descriptors.size()) * options_.depth;
    double done = 0.0;
    // Nodes are opened in the order they were made: breadth first, as the tree lies in memory.
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      tree_.first_child.push_back(static_cast<std::uint32_t>(nodes_.size()));
      const OpenNode node = nodes_[i];
      if (node.depth == options_.depth) continue;
      const bool parted = part(node);
      done += static_cast<double>(node.descriptors.size()) * (parted ? 1 : options_.depth - node.depth);
      if (options_.on_progress && !options_.on_progress(done / all))
        throw RunError("the training of the vocabulary was interrupted");
    }
    tree_.first_child.push_back(static_cast<std::uint32_t>(nodes_.size()));
    return std::move(tree_);
  }

 private:
  /// Makes the node's children; false when it stays a leaf.
  bool part(const OpenNode& node) {
    if (node.depth > 0 && node.descriptors.size() <= options_.branching) return false;
    const Clusters clusters =
        k_medians(node.descriptors, options_.branching, options_.max_iterations, random_);
    const std::size_t n = clusters.centres.size();
    if (n < 2) return false;
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t start = clusters.starts[c];
      tree_.descriptors.push_back(clusters.centres[c]);
      nodes_.push_back({node.descriptors.subspan(start, clusters.starts[c + 1] - start), node.depth + 1});
    }
    return true;
  }

  const VocabularyTrainingOptions& options_;
  Random& random_;
  VocabularyTree tree_;
  std::vector<OpenNode> nodes_;
};

std::size_t count_leaves(const VocabularyTree& tree) {
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < tree.descriptors.size(); ++i)
    leaves += tree.first_child[i] == tree.first_child[i + 1] ? 1U : 0U;
  return leaves;
}

/// Inverse document frequencies. A word that no image has comes from descriptors of one at least.
std::vector<float> weigh(const Vocabulary& unweighted, std::span<const ImageDescriptors> images) {
  std::vector<std::size_t> images_with(unweighted.n_words(), 0);
  std::vector<WordId> words;
  for (const ImageDescriptors& image : images) {
    words.clear();
    for (const Descriptor& descriptor : image) words.push_back(unweighted.word(descriptor));
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    for (const WordId word : words) ++images_with[word];
  }
  std::vector<float> weights;
  weights.reserve(images_with.size());
  const auto n = static_cast<double>(images.size());
  for (const std::size_t count : images_with)
    weights.push_back(static_cast<float>(std::log(n / static_cast<double>(std::max<std::size_t>(count, 1)))));
  return weights;
}

}  // namespace

Vocabulary train_vocabulary(std::span<const ImageDescriptors> images,
                            const VocabularyTrainingOptions& options) {
  check(options);
  Random random(options.seed);
  std::vector<Descriptor> features = choose_features(images, options.max_features, random);
  if (features.empty()) throw InputError("cannot train a vocabulary: there is no feature in the images");
  VocabularyTree tree = TreeGrower(options, random).grow(features);
  if (tree.descriptors.size() < 2)
    throw InputError("cannot train a vocabulary: all features of the images are the same");
  tree.word_weights.assign(count_leaves(tree), 1.0F);
  const Vocabulary unweighted(tree);
  tree.word_weights = weigh(unweighted, images);
  return Vocabulary(std::move(tree));
}

}  // namespace cpslam
