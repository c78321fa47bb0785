#include "sim/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cpslam::sim {
namespace {

constexpr float kMaxProbes = 8.0F;

// Without SSE4.1 std::floor is a function call.
int floor_to_int(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

struct Tap {
  int first, second;
  float weight;  // of the second
};

inline Tap tap(float coordinate, int size, bool repeat) {
  const float x = coordinate * static_cast<float>(size) - 0.5F;
  int first = floor_to_int(x);
  const float weight = x - static_cast<float>(first);
  int second = first + 1;
  if (repeat) {
    while (first < 0) first += size;
    while (first >= size) first -= size;
    second = first + 1 == size ? 0 : first + 1;
  } else {
    first = std::clamp(first, 0, size - 1);
    second = std::clamp(second, 0, size - 1);
  }
  return {first, second, weight};
}

}  // namespace

Texture::Texture(const cv::Mat& bgr, Wrap wrap) : wrap_(wrap) {
  CV_Assert(bgr.type() == CV_8UC3 && !bgr.empty());
  cv::Mat image = bgr;
  while (true) {
    Level level{image.cols, image.rows, {}};
    level.texels.reserve(image.total());
    for (int y = 0; y < image.rows; ++y) {
      for (int x = 0; x < image.cols; ++x) {
        const auto& p = image.at<cv::Vec3b>(y, x);
        level.texels.push_back({p[0], p[1], p[2], 0});
      }
    }
    levels_.push_back(std::move(level));
    if (image.cols == 1 && image.rows == 1) break;
    cv::Mat half;
    cv::resize(image, half, {std::max(1, image.cols / 2), std::max(1, image.rows / 2)}, 0, 0, cv::INTER_AREA);
    image = half;
  }
}

inline Texture::Lanes Texture::bilinear(const Level& level, float s, float t) const {
  const bool repeat = wrap_ == Wrap::kRepeat;
  const Tap x = tap(s, level.width, repeat);
  const Tap y = tap(t, level.height, repeat);
  const Texel* upper = level.texels.data() + static_cast<std::ptrdiff_t>(y.first) * level.width;
  const Texel* lower = level.texels.data() + static_cast<std::ptrdiff_t>(y.second) * level.width;
  const auto lanes = [](const Texel& texel) {
    using Bytes = std::uint8_t __attribute__((vector_size(4)));
    return __builtin_convertvector(std::bit_cast<Bytes>(texel), Lanes);
  };
  const float wd = x.weight * y.weight;
  const float wb = x.weight - wd;
  const float wc = y.weight - wd;
  const float wa = 1.0F - x.weight - wc;
  return wa * lanes(upper[x.first]) + wb * lanes(upper[x.second]) + wc * lanes(lower[x.first]) +
         wd * lanes(lower[x.second]);
}

Eigen::Array3f Texture::sample(const TextureFootprint& f) const {
  const auto width = static_cast<float>(levels_.front().width);
  const auto height = static_cast<float>(levels_.front().height);
  const float ax = f.ds_dx * width, ay = f.dt_dx * height;
  const float bx = f.ds_dy * width, by = f.dt_dy * height;
  const float a2 = ax * ax + ay * ay;
  const float b2 = bx * bx + by * by;
  const float long2 = std::max(a2, b2);
  // A surface seen edge-on may give any number, none of which may become an index.
  constexpr float kMostTiles = 1e4F;
  constexpr float kLargestFootprint2 = 1e12F;
  const auto first_tile = [this](float x) {
    if (!(std::abs(x) < kMostTiles)) return 0.0F;
    return wrap_ == Wrap::kRepeat ? x - static_cast<float>(floor_to_int(x)) : x;
  };
  const float s0 = first_tile(f.s);
  const float t0 = first_tile(f.t);
  if (!(long2 > 1.0F && long2 < kLargestFootprint2)) {  // magnified, or a degenerate footprint
    const Lanes colour = bilinear(levels_.front(), s0, t0);
    return {colour[0], colour[1], colour[2]};
  }
  const float ratio = std::sqrt(long2 / std::max(std::min(a2, b2), 1e-12F));
  const auto n_probes = static_cast<float>(std::lrint(std::min(ratio, kMaxProbes)));
  const float lod = std::max(0.0F, 0.5F * std::log2(long2 / (n_probes * n_probes)));
  const float clamped = std::min(lod, static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(clamped);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  // Blends over the middle of the way between two levels only: near either, one look-up is enough.
  const float weight = std::clamp(2.0F * (clamped - static_cast<float>(fine)) - 0.5F, 0.0F, 1.0F);
  const bool along_x = a2 >= b2;
  // A footprint longer than the picture is its mean anyway.
  const float step_s = std::clamp(along_x ? f.ds_dx : f.ds_dy, -1.0F, 1.0F) / n_probes;
  const float step_t = std::clamp(along_x ? f.dt_dx : f.dt_dy, -1.0F, 1.0F) / n_probes;
  Lanes sum{};
  for (float i = 0.5F - 0.5F * n_probes; i < 0.5F * n_probes; i += 1.0F) {
    const float s = s0 + i * step_s;
    const float t = t0 + i * step_t;
    if (weight < 1.0F) sum += (1.0F - weight) * bilinear(levels_[fine], s, t);
    if (weight > 0.0F) sum += weight * bilinear(levels_[coarse], s, t);
  }
  sum /= n_probes;
  return {sum[0], sum[1], sum[2]};
}

}  // namespace cpslam::sim
