#include "features/orb_extractor.h"

#include <cmath>
#include <string>

#include "cpslam/error.h"
#include "features/corner_detector.h"
#include "features/gaussian_blur.h"
#include "features/image_pyramid.h"
#include "features/orb_describer.h"
#include "features/orb_orientation.h"
#include "features/quadtree.h"

namespace cpslam {
namespace {

/// Shares n features out over the levels in proportion to 1 / scale_factor^level; the last level gets what
/// the rounding leaves.
std::vector<int> features_per_level(const OrbSettings& settings) {
  const double ratio = 1.0 / settings.scale_factor;
  double total = 0.0;
  for (int i = 0; i < settings.n_levels; ++i) total += std::pow(ratio, i);
  std::vector<int> wanted;
  int left = settings.n_features;
  for (int i = 0; i < settings.n_levels; ++i) {
    const bool last = i + 1 == settings.n_levels;
    const int share = static_cast<int>(std::lround(settings.n_features * std::pow(ratio, i) / total));
    wanted.push_back(last ? left : std::min(share, left));
    left -= wanted.back();
  }
  return wanted;
}

}  // namespace

struct OrbExtractor::Impl {
  explicit Impl(const OrbSettings& s)
      : pyramid(s.scale_factor, s.n_levels),
        detector(s.ini_th_fast, s.min_th_fast),
        wanted(features_per_level(s)) {}

  void extract_level(int i, OrbFeatures& features);

  ImagePyramid pyramid;
  CornerDetector detector;
  Quadtree quadtree;
  GaussianBlur blur;
  OrbDescriber describer;
  std::vector<int> wanted;  // features per level
  std::vector<Corner> corners;
  std::vector<float> angles_deg;
};

OrbExtractor::OrbExtractor(const OrbSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
OrbExtractor::~OrbExtractor() = default;
OrbExtractor::OrbExtractor(OrbExtractor&&) noexcept = default;
OrbExtractor& OrbExtractor::operator=(OrbExtractor&&) noexcept = default;

void OrbExtractor::extract(const cv::Mat& grey, OrbFeatures& features) {
  if (!grey.empty() && grey.type() != CV_8UC1) {
    throw InputError("ORB features need an 8-bit grey image, not OpenCV type " + std::to_string(grey.type()) +
                     ": convert it first");
  }
  features.keypoints.clear();
  features.descriptors.clear();
  impl_->pyramid.build(grey);
  for (int i = 0; i < impl_->pyramid.n_levels(); ++i) impl_->extract_level(i, features);
}

void OrbExtractor::Impl::extract_level(int i, OrbFeatures& features) {
  const cv::Mat& level = pyramid.level(i);
  detector.detect(level, corners);
  const cv::Rect region(kOrbBorderPx, kOrbBorderPx, level.cols - 2 * kOrbBorderPx,
                        level.rows - 2 * kOrbBorderPx);
  quadtree.distribute(region, wanted[static_cast<std::size_t>(i)], corners);
  if (corners.empty()) return;
  orient_corners(level, corners, best_simd(), angles_deg);
  const cv::Mat& blurred = blur.blur(level);
  const float scale = pyramid.scale(i);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Corner& c = corners[k];
    features.keypoints.push_back({static_cast<float>(c.x) * scale, static_cast<float>(c.y) * scale,
                                  angles_deg[k], static_cast<float>(c.response), i});
    features.descriptors.push_back(describer.describe(blurred, c.x, c.y, angles_deg[k]));
  }
}

}  // namespace cpslam
