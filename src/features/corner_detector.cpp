#include "features/corner_detector.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "features/fast_score.h"
#include "features/image_pyramid.h"

namespace cpslam {
namespace {

constexpr int kMargin = 32;               // suppression reads one element before the row
constexpr int kFirst = kOrbBorderPx - 1;  // suppression needs the ring around the allowed region

/// Eight bytes, the first in the lowest bits.
std::uint64_t load_word(const std::uint8_t* bytes) {
  std::uint64_t word = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&word, bytes, sizeof(word));
  } else {
    for (int i = 7; i >= 0; --i) word = (word << 8U) | bytes[i];
  }
  return word;
}

}  // namespace

CornerDetector::CornerDetector(int threshold, Simd simd) : threshold_(threshold), simd_(simd) {}

void CornerDetector::prepare(int level_width) {
  const auto row_size = static_cast<std::size_t>(level_width + 2 * kMargin + kFastBlock);
  for (std::vector<std::uint8_t>& row : contrast_) row.assign(row_size, 0);
  kept_.assign(row_size, 0);
  busy_words_.resize(row_size / sizeof(std::uint64_t) + 1);
}

void CornerDetector::detect(const cv::Mat& level, std::vector<Corner>& corners) {
  corners.clear();
  prepare(level.cols);
  const int count = level.cols - 2 * kFirst;
  const int last = level.rows - kFirst - 1;  // the ring's last row
  for (int y = kFirst; y <= last; ++y) {
    std::uint8_t* below = contrast_[y % 3].data() + kMargin;
    fast_contrast_row(level.ptr(y) + kFirst, static_cast<std::ptrdiff_t>(level.step), count, threshold_,
                      below, simd_);
    if (y < kFirst + 2) continue;
    suppress_non_maxima_row(contrast_[(y - 2) % 3].data() + kMargin, contrast_[(y - 1) % 3].data() + kMargin,
                            below, count, threshold_, kept_.data() + kMargin, simd_);
    // What belongs to the ring and to the rounding up to whole blocks is no corner.
    kept_[kMargin] = 0;
    std::fill(kept_.begin() + kMargin + count - 1, kept_.end(), std::uint8_t{0});
    collect_row(y - 1, corners);
  }
}

void CornerDetector::collect_row(int y, std::vector<Corner>& corners) {
  // Corners are rare and fall at random, so branches on them are mispredicted: gather the words with corners
  // first.
  std::size_t n_words = 0;
  for (std::size_t i = kMargin; i + sizeof(std::uint64_t) <= kept_.size(); i += sizeof(std::uint64_t)) {
    busy_words_[n_words] = i;
    n_words += load_word(&kept_[i]) != 0 ? 1U : 0U;
  }
  for (std::size_t w = 0; w < n_words; ++w) {
    // One corner per turn: strict maxima are never neighbours, mostly there is one in a word.
    for (std::uint64_t word = load_word(&kept_[busy_words_[w]]); word != 0;) {
      const int byte = std::countr_zero(word) / 8;
      const int x = static_cast<int>(busy_words_[w]) + byte - kMargin + kFirst;
      const int response = static_cast<int>((word >> (8 * byte)) & 255U) - 1;
      word &= ~(std::uint64_t{255} << (8 * byte));
      corners.push_back({x, y, response});
    }
  }
}

}  // namespace cpslam
