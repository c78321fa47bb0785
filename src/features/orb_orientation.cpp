#include "features/orb_orientation.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace cpslam {
namespace {

constexpr int kRadius = 15;
constexpr int kColumns = 32;  // -kRadius .. kRadius and one of no weight

/// Half width of the disc's rows 0 to 15. The circle is rounded up to the diagonal and mirrored beyond it, so
/// that the disc is the same in x and y.
constexpr std::array<int, kRadius + 1> kHalfWidth{15, 15, 15, 15, 14, 14, 14, 13, 13, 12, 11, 10, 9, 8, 6, 3};

/// All ones (-1) where the disc covers column u of rows v and -v, else 0.
using DiscMask = std::array<std::array<std::int16_t, kColumns>, kRadius + 1>;

constexpr DiscMask make_disc_mask() {
  DiscMask mask{};
  for (int v = 0; v <= kRadius; ++v) {
    const int half = kHalfWidth[static_cast<std::size_t>(v)];
    for (int u = -half; u <= half; ++u)
      mask[static_cast<std::size_t>(v)][static_cast<std::size_t>(u + kRadius)] = -1;
  }
  return mask;
}
constexpr DiscMask kDiscMask = make_disc_mask();

CPSLAM_KERNEL PatchMoments moments(const std::uint8_t* centre, std::ptrdiff_t step) {
  // Column sums of rows v and -v together: 31 * 255 and 120 * 255 fit into 16 bits.
  std::array<std::int16_t, kColumns> sum;
  std::array<std::int16_t, kColumns> weighted_by_v{};
  const std::uint8_t* middle = centre - kRadius;
  for (std::size_t i = 0; i < kColumns; ++i) sum[i] = static_cast<std::int16_t>(middle[i] & kDiscMask[0][i]);
  for (int v = 1; v <= kRadius; ++v) {
    const std::uint8_t* above = middle - v * step;
    const std::uint8_t* below = middle + v * step;
    const auto& mask = kDiscMask[static_cast<std::size_t>(v)];
    for (std::size_t i = 0; i < kColumns; ++i) {
      const int both = (below[i] + above[i]) & mask[i];
      const int difference = (below[i] - above[i]) & mask[i];
      sum[i] = static_cast<std::int16_t>(sum[i] + both);
      weighted_by_v[i] = static_cast<std::int16_t>(weighted_by_v[i] + v * difference);
    }
  }
  PatchMoments m;
  for (int i = 0; i < kColumns; ++i) {
    m.m10 += (i - kRadius) * sum[static_cast<std::size_t>(i)];
    m.m01 += weighted_by_v[static_cast<std::size_t>(i)];
  }
  return m;
}

CPSLAM_TARGET_AVX2 PatchMoments moments_avx2(const std::uint8_t* centre, std::ptrdiff_t step) {
  return moments(centre, step);
}

}  // namespace

PatchMoments patch_moments(const cv::Mat& level, int x, int y, Simd simd) {
  const auto step = static_cast<std::ptrdiff_t>(level.step);
  const std::uint8_t* centre = level.ptr(y) + x;
  return simd == Simd::kAvx2 ? moments_avx2(centre, step) : moments(centre, step);
}

void orient_corners(const cv::Mat& level, const std::vector<Corner>& corners, Simd simd,
                    std::vector<float>& angles_deg) {
  angles_deg.clear();
  for (const Corner& c : corners) {
    const PatchMoments m = patch_moments(level, c.x, c.y, simd);
    angles_deg.push_back(cv::fastAtan2(static_cast<float>(m.m01), static_cast<float>(m.m10)));
  }
}

}  // namespace cpslam
