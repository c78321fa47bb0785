#include "sim/texture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cpslam::sim {
namespace {

constexpr float kMaxProbes = 8.0F;

struct Tap {
  int first, second;
  float weight;  // of the second
};

Tap tap(float coordinate, int size, bool repeat) {
  const float x = coordinate * static_cast<float>(size) - 0.5F;
  const float base = std::floor(x);
  int first = static_cast<int>(base);
  int second = first + 1;
  if (repeat) {
    if (first < 0) first += size;
    if (second >= size) second -= size;
  } else {
    first = std::clamp(first, 0, size - 1);
    second = std::clamp(second, 0, size - 1);
  }
  return {first, second, x - base};
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

Eigen::Array3f Texture::bilinear(const Level& level, float s, float t) const {
  const bool repeat = wrap_ == Wrap::kRepeat;
  if (repeat) {
    s -= std::floor(s);
    t -= std::floor(t);
  }
  const Tap x = tap(s, level.width, repeat);
  const Tap y = tap(t, level.height, repeat);
  const Texel* upper = level.texels.data() + static_cast<std::ptrdiff_t>(y.first) * level.width;
  const Texel* lower = level.texels.data() + static_cast<std::ptrdiff_t>(y.second) * level.width;
  const Texel& a = upper[x.first];
  const Texel& b = upper[x.second];
  const Texel& c = lower[x.first];
  const Texel& d = lower[x.second];
  const float wd = x.weight * y.weight;
  const float wb = x.weight - wd;
  const float wc = y.weight - wd;
  const float wa = 1.0F - x.weight - wc;
  Eigen::Array3f colour;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    colour[i] = wa * static_cast<float>(a[k]) + wb * static_cast<float>(b[k]) +
                wc * static_cast<float>(c[k]) + wd * static_cast<float>(d[k]);
  }
  return colour;
}

Eigen::Array3f Texture::sample(const TextureFootprint& f) const {
  const auto width = static_cast<float>(levels_.front().width);
  const auto height = static_cast<float>(levels_.front().height);
  const float ax = f.ds_dx * width, ay = f.dt_dx * height;
  const float bx = f.ds_dy * width, by = f.dt_dy * height;
  const float a2 = ax * ax + ay * ay;
  const float b2 = bx * bx + by * by;
  const float long2 = std::max(a2, b2);
  if (!(long2 > 1.0F)) return bilinear(levels_.front(), f.s, f.t);  // magnified, or a degenerate footprint

  const float ratio = std::sqrt(long2 / std::max(std::min(a2, b2), 1e-12F));
  const float n_probes = std::min(std::round(ratio), kMaxProbes);
  const float lod = std::max(0.0F, 0.5F * std::log2(long2) - std::log2(n_probes));
  const float last = static_cast<float>(levels_.size() - 1);
  const float clamped = std::min(lod, last);
  const auto fine = static_cast<std::size_t>(clamped);
  const std::size_t coarse = std::min(fine + 1, levels_.size() - 1);
  const float weight = clamped - static_cast<float>(fine);
  const bool along_x = a2 >= b2;
  const float step_s = (along_x ? f.ds_dx : f.ds_dy) / n_probes;
  const float step_t = (along_x ? f.dt_dx : f.dt_dy) / n_probes;
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (float i = 0.5F - 0.5F * n_probes; i < 0.5F * n_probes; i += 1.0F) {
    const float s = f.s + i * step_s;
    const float t = f.t + i * step_t;
    sum += (1.0F - weight) * bilinear(levels_[fine], s, t);
    if (weight > 0.0F) sum += weight * bilinear(levels_[coarse], s, t);
  }
  return sum / n_probes;
}

}  // namespace cpslam::sim
