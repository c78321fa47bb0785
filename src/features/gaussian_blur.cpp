#include "features/gaussian_blur.h"

#include <array>
#include <cstddef>

namespace cpslam {
namespace {

constexpr int kReach = 3;
constexpr int kBlock = 32;   // the kernels work on whole blocks of pixels
constexpr int kMargin = 32;  // of the row buffers

using Weights = std::array<std::uint16_t, 4>;  // of the centre and of distances 1 to 3
using SevenRows = std::array<const std::uint8_t*, 7>;

/// Weighted sum of seven rows in 1/128 grey values; at most 255 * 128.
CPSLAM_KERNEL void sum_rows(const SevenRows& rows, const Weights& weights, int count,
                            std::uint16_t* __restrict sum) {
  const unsigned w0 = weights[0], w1 = weights[1], w2 = weights[2], w3 = weights[3];
  for (int x = 0; x < count; x += kBlock) {
    for (int i = x; i < x + kBlock; ++i) {
      sum[i] = static_cast<std::uint16_t>(w0 * rows[3][i] + w1 * (0U + rows[2][i] + rows[4][i]) +
                                          w2 * (0U + rows[1][i] + rows[5][i]) +
                                          w3 * (0U + rows[0][i] + rows[6][i]));
    }
  }
}

/// Weighted sum of seven columns of such sums, rounded to grey values. High and low bytes are summed apart so
/// that 16 bits hold every value: (256 * high + low + 2^13) / 2^14 = (high + low / 256 + 2^5) / 2^6, rounding
/// down.
CPSLAM_KERNEL void sum_columns(const std::uint16_t* sum, const Weights& weights, int count,
                               std::uint8_t* __restrict blurred) {
  const unsigned w0 = weights[0], w1 = weights[1], w2 = weights[2], w3 = weights[3];
  for (int x = 0; x < count; x += kBlock) {
    for (int i = x; i < x + kBlock; ++i) {
      const std::uint16_t p0 = sum[i];
      const auto p1 = static_cast<std::uint16_t>(sum[i - 1] + sum[i + 1]);
      const auto p2 = static_cast<std::uint16_t>(sum[i - 2] + sum[i + 2]);
      const auto p3 = static_cast<std::uint16_t>(sum[i - 3] + sum[i + 3]);
      const auto high =
          static_cast<std::uint16_t>(w0 * (p0 >> 8U) + w1 * (p1 >> 8U) + w2 * (p2 >> 8U) + w3 * (p3 >> 8U));
      const auto low = static_cast<std::uint16_t>(w0 * (p0 & 255U) + w1 * (p1 & 255U) + w2 * (p2 & 255U) +
                                                  w3 * (p3 & 255U));
      blurred[i] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(high + (low >> 8U) + 32U) >> 6U);
    }
  }
}

void mirror_margins(std::uint16_t* row, int width) {
  for (int i = 1; i <= kReach; ++i) {
    row[-i] = row[i];
    row[width - 1 + i] = row[width - 1 - i];
  }
}

CPSLAM_KERNEL void blur_row(const SevenRows& rows, const Weights& weights, int width, std::uint16_t* sum,
                            std::uint8_t* blurred) {
  sum_rows(rows, weights, width, sum);
  mirror_margins(sum, width);
  sum_columns(sum, weights, width, blurred);
}

CPSLAM_TARGET_AVX2 void blur_row_avx2(const SevenRows& rows, const Weights& weights, int width,
                                      std::uint16_t* sum, std::uint8_t* blurred) {
  blur_row(rows, weights, width, sum, blurred);
}

}  // namespace

const cv::Mat& GaussianBlur::blur(const cv::Mat& image) {
  const auto row_size = static_cast<std::size_t>(image.cols + 2 * kMargin + kBlock);
  if (sum_.size() < row_size) sum_.resize(row_size);
  if (memory_.size() < image.step * static_cast<std::size_t>(image.rows)) {
    memory_.resize(image.step * static_cast<std::size_t>(image.rows));
  }
  result_ = cv::Mat(image.rows, image.cols, CV_8UC1, memory_.data(), image.step);
  std::uint16_t* sum = sum_.data() + kMargin;
  for (int y = 0; y < image.rows; ++y) {
    SevenRows rows;
    for (int k = -kReach; k <= kReach; ++k) {
      const int mirrored = y + k < 0             ? -(y + k)
                           : y + k >= image.rows ? 2 * (image.rows - 1) - (y + k)
                                                 : y + k;
      rows[static_cast<std::size_t>(k + kReach)] = image.ptr(mirrored);
    }
    if (simd_ == Simd::kAvx2) {
      blur_row_avx2(rows, weights_, image.cols, sum, result_.ptr(y));
    } else {
      blur_row(rows, weights_, image.cols, sum, result_.ptr(y));
    }
  }
  return result_;
}

}  // namespace cpslam
