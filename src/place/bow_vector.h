#pragma once

#include <cstdint>
#include <vector>

namespace cpslam {

using WordId = std::uint32_t;

/// A word of an image and how much of the image it is.
struct WordWeight {
  WordId word = 0;
  float weight = 0.0F;  ///< > 0; the weights of an image sum to 1
};

/// An image as a bag of words (Sivic and Zisserman 2003): by ascending word, each word once. Empty for an
/// image without features.
using BowVector = std::vector<WordWeight>;

/// How alike two images are, 0 (no common word) to 1 (the same bag): 1 - |a - b|_1 / 2 (Nister and Stewenius
/// 2006), which for bags that sum to 1 is the sum of the smaller weights of common words. Both bags come from
/// the same vocabulary.
[[nodiscard]] double score(const BowVector& a, const BowVector& b);

}  // namespace cpslam
