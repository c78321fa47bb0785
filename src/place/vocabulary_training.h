#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "features/descriptor.h"
#include "place/vocabulary.h"

namespace cpslam {

struct VocabularyTrainingOptions {
  std::uint32_t branching = 10;
  std::uint32_t depth = 5;
  std::size_t max_features = 2'000'000;  ///< the tree is grown on a random choice of so many
  int max_iterations = 11;               ///< of k-medians, for each node
  std::uint64_t seed = 0;
  /// Called between two nodes with the share of the work that is done, 0 to 1; false ends the training.
  std::function<bool(double)> on_progress;
};

/// The features of one image.
using ImageDescriptors = std::vector<Descriptor>;

/// Grows a vocabulary from the features of images: each node's descriptors are parted by k_medians until
/// they lie `depth` levels deep or are too few to part (no more than branches). A word's weight is the
/// logarithm of the images per image that has it, counted over all features of all images. Deterministic: the
/// same images, options and seed give the same vocabulary. Throws InputError for options out of range or
/// images without two different features, RunError when on_progress ends it.
[[nodiscard]] Vocabulary train_vocabulary(std::span<const ImageDescriptors> images,
                                          const VocabularyTrainingOptions& options);

}  // namespace cpslam
