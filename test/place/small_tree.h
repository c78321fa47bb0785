#pragma once

#include <vector>

#include "place/vocabulary.h"
#include "place/vocabulary_training.h"
#include "support/synthetic.h"

namespace cpslam::test {

inline Descriptor bits(std::uint64_t first_word) {
  return Descriptor{{first_word, 0, 0, 0}};
}

/// Root with children 1 (inner, all zero) and 2 (leaf, word 0, 64 ones); 1 has the children 3 (leaf, word 1,
/// all zero) and 4 (leaf, word 2, 8 ones).
inline VocabularyTree small_tree() {
  VocabularyTree tree;
  tree.branching = 2;
  tree.depth = 2;
  tree.descriptors = {bits(0), bits(0), bits(~std::uint64_t{0}), bits(0), bits(0xFF)};
  tree.first_child = {1, 3, 5, 5, 5, 5};
  tree.word_weights = {1.0F, 2.0F, 0.5F};
  return tree;
}

/// Images of n features each, every feature one of n_looks random descriptors with some bits turned over.
inline std::vector<ImageDescriptors> random_images(std::size_t n_images, std::size_t n_features,
                                                   std::size_t n_looks, Random& random) {
  std::vector<Descriptor> looks;
  for (std::size_t i = 0; i < n_looks; ++i) looks.push_back(synthetic::random_descriptor(random));
  std::vector<ImageDescriptors> images(n_images);
  for (ImageDescriptors& image : images) {
    for (std::size_t i = 0; i < n_features; ++i) {
      const int first_bit = static_cast<int>(random.index(248));
      image.push_back(synthetic::flipped(looks[random.index(n_looks)], 8, first_bit));
    }
  }
  return images;
}

inline Vocabulary random_vocabulary(std::uint32_t branching, std::uint32_t depth, std::uint64_t seed) {
  Random random(seed);
  VocabularyTrainingOptions options;
  options.branching = branching;
  options.depth = depth;
  options.seed = seed;
  return train_vocabulary(random_images(20, 100, 300, random), options);
}

}  // namespace cpslam::test
