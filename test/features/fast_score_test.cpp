#include "features/fast_score.h"

#include <gtest/gtest.h>

#include "features/image_pyramid.h"
#include "test_images.h"

namespace cpslam {
namespace {

/// Contrast of one pixel straight from the definition.
int contrast_by_definition(const cv::Mat& image, int x, int y) {
  constexpr int kX[16] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  constexpr int kY[16] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  const int centre = image.at<std::uint8_t>(y, x);
  int best = 0;
  for (int start = 0; start < 16; ++start) {
    int brighter = 255;
    int darker = 255;
    for (int k = 0; k < 9; ++k) {
      const int i = (start + k) % 16;
      const int difference = image.at<std::uint8_t>(y + kY[i], x + kX[i]) - centre;
      brighter = std::min(brighter, difference);
      darker = std::min(darker, -difference);
    }
    best = std::max({best, brighter, darker});
  }
  return best;
}

TEST(FastScore, EqualsTheDefinitionOnEveryPixel) {
  for (const cv::Mat& image : {test::noise_image(150, 60, 1), test::textured_image(150, 60, 2)}) {
    ImagePyramid pyramid(1.2, 1);
    pyramid.build(image);
    const cv::Mat& level = pyramid.level(0);
    constexpr int kCount = 150 - 6;
    for (const Simd simd : test::simds()) {
      int n_corners = 0;
      for (int y = 3; y < 57; ++y) {
        std::vector<std::uint8_t> contrast(kCount + kFastBlock);
        fast_contrast_row(level.ptr(y) + 3, static_cast<std::ptrdiff_t>(level.step), kCount, 7,
                          contrast.data(), simd);
        for (int i = 0; i < kCount; ++i) {
          const int expected = contrast_by_definition(level, i + 3, y);
          // A block without any corner at the threshold may be left at zero.
          const int found = contrast[static_cast<std::size_t>(i)];
          if (expected > 7) ++n_corners;
          ASSERT_TRUE(found == expected || (found == 0 && expected <= 7)) << i << " " << y;
        }
      }
      EXPECT_GT(n_corners, 50);
    }
  }
}

TEST(FastScore, SuppressionKeepsStrictMaximaOnly) {
  Random random(3);
  constexpr std::size_t kCount = 2 * kFastBlock;
  std::vector<std::vector<std::uint8_t>> rows(3, std::vector<std::uint8_t>(kCount + 2));
  for (auto& row : rows) {
    for (auto& value : row) value = static_cast<std::uint8_t>(random.index(12));
  }
  for (const Simd simd : test::simds()) {
    std::vector<std::uint8_t> kept(kCount);
    suppress_non_maxima_row(&rows[0][1], &rows[1][1], &rows[2][1], kCount, 5, kept.data(), simd);
    int n_kept = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      bool is_maximum = rows[1][i + 1] > 5;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = i; c < i + 3; ++c) {
          if ((r != 1 || c != i + 1) && rows[r][c] >= rows[1][i + 1]) is_maximum = false;
        }
      }
      EXPECT_EQ(kept[i], is_maximum ? rows[1][i + 1] : 0) << i;
      n_kept += is_maximum ? 1 : 0;
    }
    EXPECT_GT(n_kept, 0);
  }
}

}  // namespace
}  // namespace cpslam
