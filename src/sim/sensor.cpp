#include "sim/sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "camera/depth_noise.h"

namespace cpslam::sim {
namespace {

constexpr double kDisparityStep_px = 0.125;

// Close to a standard normal: the sum of four 16-bit uniforms has variance 1/3 of a unit each.
float quick_normal(Random& random) {
  const std::uint64_t bits = random.next();
  const auto sum = static_cast<std::int64_t>((bits & 0xFFFFU) + ((bits >> 16U) & 0xFFFFU) +
                                             ((bits >> 32U) & 0xFFFFU) + (bits >> 48U));
  constexpr float kScale = 1.7320508F / 65536.0F;
  return static_cast<float>(sum - std::int64_t{131070}) * kScale;
}

// Unit variance, shared by neighbours as the windows of a stereo matcher share pixels.
cv::Mat correlated_noise(cv::Size size, double sigma_px, Random& random) {
  cv::Mat white(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    auto* row = white.ptr<float>(y);
    for (int x = 0; x < size.width; ++x) row[x] = quick_normal(random);
  }
  constexpr int kTaps = 7;
  const cv::Mat kernel = cv::getGaussianKernel(kTaps, sigma_px, CV_64F);
  cv::Mat noise;
  cv::sepFilter2D(white, noise, CV_32F, kernel, kernel, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  return noise / kernel.dot(kernel);
}

std::uint16_t to_units(double depth_m, double factor) {
  const double units = std::round(depth_m * factor);
  return units > 0.0 && units <= 65535.0 ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
}

// Holes of one row where the projector, to the right of the camera, does not see what the camera sees.
void cut_projector_shadow(const float* depth_m, int width, double bf, std::uint8_t* usable) {
  double leftmost = static_cast<double>(width);
  for (int x = width - 1; x >= 0; --x) {
    if (!(depth_m[x] > 0.0F)) continue;
    const double seen_at = x - bf / static_cast<double>(depth_m[x]);
    if (seen_at > leftmost + 0.5) usable[x] = 0;
    leftmost = std::min(leftmost, seen_at);
  }
}

// Noise in disparity that, with the quantisation, gives the sensor's standard deviation in depth.
double measured_depth(double depth_m, double bf, double normal) {
  const double disparity_per_m = bf / (depth_m * depth_m);
  const double quantisation_m = kDisparityStep_px / disparity_per_m / std::sqrt(12.0);
  const double sigma_m = structured_light_sigma_m(depth_m);
  const double rest_m = std::sqrt(std::max(0.0, sigma_m * sigma_m - quantisation_m * quantisation_m));
  const double disparity = bf / depth_m + normal * rest_m * disparity_per_m;
  const double quantised = kDisparityStep_px * std::round(disparity / kDisparityStep_px);
  return quantised > 0.0 ? bf / quantised : 0.0;
}

// The pixel whose surface is measured here: object edges are ragged by about half a pixel.
float ragged_depth(const cv::Mat& depth_m, int x, int y, float shift_x, float shift_y) {
  const float here = depth_m.at<float>(y, x);
  const int other_x = std::clamp(x + static_cast<int>(std::lround(shift_x)), 0, depth_m.cols - 1);
  const int other_y = std::clamp(y + static_cast<int>(std::lround(shift_y)), 0, depth_m.rows - 1);
  const float other = depth_m.at<float>(other_y, other_x);
  // Slanted surfaces are no edges.
  return std::abs(other - here) > 0.06F * here ? other : here;
}

}  // namespace

cv::Mat exact_depth(const cv::Mat& depth_m, double depth_map_factor) {
  cv::Mat depth(depth_m.size(), CV_16UC1);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x)
      depth.at<std::uint16_t>(y, x) =
          to_units(static_cast<double>(depth_m.at<float>(y, x)), depth_map_factor);
  return depth;
}

cv::Mat structured_light_depth(const RenderedView& view, const CameraSettings& camera, Random& random) {
  constexpr float kRaggedness_px = 0.6F;
  constexpr double kGrazingNever = 0.06, kGrazingAlways = 0.17;  // cosines at which depth is lost, is safe
  const cv::Mat axial = correlated_noise(view.depth_m.size(), 0.8, random);
  const cv::Mat shift_x = correlated_noise(view.depth_m.size(), 1.0, random);
  const cv::Mat shift_y = correlated_noise(view.depth_m.size(), 1.0, random);
  cv::Mat usable = view.depth_return.clone();
  cv::Mat depth(view.depth_m.size(), CV_16UC1, cv::Scalar(0));
  for (int y = 0; y < depth.rows; ++y) {
    auto* usable_row = usable.ptr<std::uint8_t>(y);
    cut_projector_shadow(view.depth_m.ptr<float>(y), depth.cols, camera.bf, usable_row);
    for (int x = 0; x < depth.cols; ++x) {
      if (usable_row[x] == 0) continue;
      const double safe = (static_cast<double>(view.cosine.at<float>(y, x)) - kGrazingNever) /
                          (kGrazingAlways - kGrazingNever);
      if (safe < 1.0 && random.uniform() > safe) continue;
      const auto surface_m =
          static_cast<double>(ragged_depth(view.depth_m, x, y, kRaggedness_px * shift_x.at<float>(y, x),
                                           kRaggedness_px * shift_y.at<float>(y, x)));
      if (!(surface_m > 0.0)) continue;
      const double measured_m =
          measured_depth(surface_m, camera.bf, static_cast<double>(axial.at<float>(y, x)));
      if (measured_m < kNearestDepth_m || measured_m > kFarthestDepth_m) continue;
      depth.at<std::uint16_t>(y, x) = to_units(measured_m, camera.depth_map_factor);
    }
  }
  return depth;
}

cv::Mat develop_colour(const cv::Mat& colour_bgr, double gain, bool noise, Random& random) {
  cv::Mat developed(colour_bgr.size(), CV_8UC3);
  const auto factor = static_cast<float>(gain);
  const int n = 3 * colour_bgr.cols;
  for (int y = 0; y < colour_bgr.rows; ++y) {
    const auto* in = colour_bgr.ptr<float>(y);
    auto* out = developed.ptr<std::uint8_t>(y);
    for (int i = 0; i < n; ++i) {
      float value = std::min(255.0F, factor * in[i]);
      if (noise) value += std::sqrt(1.0F + 0.02F * value) * quick_normal(random);
      out[i] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
    }
  }
  return developed;
}

}  // namespace cpslam::sim
