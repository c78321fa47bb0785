#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace cpslam::sim {

/// Where a pixel falls on a texture: coordinates in [0, 1] (t down) and their derivatives by the pixel.
struct TextureFootprint {
  float s = 0.0F, t = 0.0F;
  float ds_dx = 0.0F, dt_dx = 0.0F;
  float ds_dy = 0.0F, dt_dy = 0.0F;
};

/// A picture with its mip pyramid. Immutable, so safe to share between threads.
class Texture {
 public:
  enum class Wrap { kRepeat, kClamp };

  /// bgr: CV_8UC3.
  Texture(const cv::Mat& bgr, Wrap wrap);

  /// Mean colour (B, G, R in [0, 255]) under the footprint: trilinear, with up to 8 probes along its long
  /// axis (after Barkans 1997), so that patterns seen at a slant neither alias into false corners nor smear
  /// out.
  [[nodiscard]] Eigen::Array3f sample(const TextureFootprint& footprint) const;

 private:
  using Texel = std::array<std::uint8_t, 4>;
  struct Level {
    int width = 0, height = 0;
    std::vector<Texel> texels;
  };
  /// Four floats in one register; three of them used.
  using Lanes = float __attribute__((vector_size(16)));
  /// s and t at most one picture outside [0, 1].
  [[nodiscard]] Lanes bilinear(const Level& level, float s, float t) const;

  std::vector<Level> levels_;
  Wrap wrap_;
};

}  // namespace cpslam::sim
