#include "features/orb_extractor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "cpslam/error.h"
#include "features/corner_cells.h"
#include "features/corner_detector.h"
#include "features/gaussian_blur.h"
#include "features/image_mask.h"
#include "features/image_pyramid.h"
#include "features/level_budget.h"
#include "features/orb_describer.h"
#include "features/orb_orientation.h"
#include "features/quadtree.h"

namespace cpslam {
namespace {

constexpr int kTakenPx = 2;  // a feature keeps new ones this far away

/// A level's corners: `all` stays for extract_more(), the others are worked on.
struct LevelCorners {
  std::vector<Corner> all;  // raster order, from the lower threshold on
  std::vector<Corner>
      chosen;                // outside the mask by the rule of the two thresholds; at last those to describe
  std::vector<Corner> weak;  // what the rule leaves out there
  std::vector<Corner> inside;  // in the mask, by the same rule

  void clear_choice() {
    chosen.clear();
    weak.clear();
    inside.clear();
  }
};

}  // namespace

struct OrbExtractor::Impl {
  explicit Impl(const OrbSettings& s)
      : settings(s),
        pyramid(s.scale_factor, s.n_levels),
        detector(std::min(s.ini_th_fast, s.min_th_fast)),
        cells(s.ini_th_fast),
        wanted(share_over_levels(s.n_features, s)),
        levels(wanted.size()) {}

  void detect(const cv::Mat& grey);
  void choose_plainly();
  void choose_outside(const ImageMask& people, int n_on_people);
  void choose_new(const ImageMask& excluded, int n, const OrbFeatures& features);
  void divide(std::size_t i, const ImageMask& mask);
  void drop_taken(std::size_t i, const OrbFeatures& features);
  void apply_thresholds(std::size_t i);
  void fit_and_spread(const std::vector<int>& budget, const std::vector<int>& budget_inside);
  void spread(std::size_t i, int budget, int budget_inside);
  void describe(OrbFeatures& features);
  [[nodiscard]] const cv::Mat& picture(std::size_t i) const { return pyramid.level(static_cast<int>(i)); }

  OrbSettings settings;
  ImagePyramid pyramid;
  CornerDetector detector;
  CornerCells cells;
  Quadtree quadtree;
  GaussianBlur blur;
  OrbDescriber describer;
  cv::Size image_size;
  std::vector<int> wanted;  // features per level
  std::vector<LevelCorners> levels;
  std::vector<Corner> outside, inside;  // of the mask, on the level being worked on
  cv::Mat1b taken;
  std::vector<float> angles_deg;
};

OrbExtractor::OrbExtractor(const OrbSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
OrbExtractor::~OrbExtractor() = default;
OrbExtractor::OrbExtractor(OrbExtractor&&) noexcept = default;
OrbExtractor& OrbExtractor::operator=(OrbExtractor&&) noexcept = default;

void OrbExtractor::extract(const cv::Mat& grey, OrbFeatures& features, const ExtractionPrior& prior) {
  if (!grey.empty() && grey.type() != CV_8UC1) {
    throw InputError("ORB features need an 8-bit grey image, not OpenCV type " + std::to_string(grey.type()) +
                     ": convert it first");
  }
  const ImageMask people(prior.people, grey.size());
  features.keypoints.clear();
  features.descriptors.clear();
  impl_->detect(grey);
  if (people.empty()) {
    impl_->choose_plainly();
  } else {
    impl_->choose_outside(people, prior.n_on_people);
  }
  impl_->describe(features);
}

int OrbExtractor::extract_more(const cv::Mat& excluded, int wanted, OrbFeatures& features) {
  const std::size_t n_before = features.keypoints.size();
  impl_->choose_new(ImageMask(excluded, impl_->image_size), wanted, features);
  impl_->describe(features);
  return static_cast<int>(features.keypoints.size() - n_before);
}

void OrbExtractor::Impl::detect(const cv::Mat& grey) {
  image_size = grey.size();
  pyramid.build(grey);
  for (LevelCorners& level : levels) level.all.clear();
  for (int i = 0; i < pyramid.n_levels(); ++i)
    detector.detect(pyramid.level(i), levels[static_cast<std::size_t>(i)].all);
}

void OrbExtractor::Impl::choose_plainly() {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LevelCorners& level = levels[i];
    level.clear_choice();
    if (level.all.empty()) continue;
    cells.set_level(picture(i).size());
    cells.select(level.all, level.chosen, nullptr);
    spread(i, wanted[i], 0);
  }
}

void OrbExtractor::Impl::choose_outside(const ImageMask& people, int n_on_people) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    divide(i, people);
    apply_thresholds(i);
  }
  fit_and_spread(wanted, share_over_levels(std::max(n_on_people, 0), settings));
}

void OrbExtractor::Impl::choose_new(const ImageMask& excluded, int n, const OrbFeatures& features) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    divide(i, excluded);
    inside.clear();
    drop_taken(i, features);
    apply_thresholds(i);
  }
  fit_and_spread(share_over_levels(std::max(n, 0), settings), std::vector<int>(levels.size(), 0));
}

void OrbExtractor::Impl::divide(std::size_t i, const ImageMask& mask) {
  outside.clear();
  inside.clear();
  const float scale = pyramid.scale(static_cast<int>(i));
  for (const Corner& c : levels[i].all) {
    const bool covered =
        !mask.empty() && mask.covers(static_cast<float>(c.x) * scale, static_cast<float>(c.y) * scale);
    (covered ? inside : outside).push_back(c);
  }
}

void OrbExtractor::Impl::drop_taken(std::size_t i, const OrbFeatures& features) {
  if (outside.empty()) return;
  const cv::Size size = picture(i).size();
  const float scale = pyramid.scale(static_cast<int>(i));
  taken.create(size);
  taken.setTo(0);
  for (const OrbKeypoint& k : features.keypoints) {
    if (k.octave != static_cast<int>(i)) continue;
    const auto x = static_cast<int>(std::lround(k.x / scale));
    const auto y = static_cast<int>(std::lround(k.y / scale));
    const cv::Rect around(x - kTakenPx, y - kTakenPx, 2 * kTakenPx + 1, 2 * kTakenPx + 1);
    taken(around & cv::Rect({}, size)).setTo(1);
  }
  std::erase_if(outside, [this](const Corner& c) { return taken(c.y, c.x) != 0; });
}

void OrbExtractor::Impl::apply_thresholds(std::size_t i) {
  LevelCorners& level = levels[i];
  level.clear_choice();
  if (level.all.empty()) return;
  cells.set_level(picture(i).size());
  cells.select(outside, level.chosen, &level.weak);
  cells.select(inside, level.inside, nullptr);
}

void OrbExtractor::Impl::fit_and_spread(const std::vector<int>& budget,
                                        const std::vector<int>& budget_inside) {
  std::vector<int> n_outside;
  std::vector<int> n_inside;
  for (const LevelCorners& level : levels) {
    n_outside.push_back(static_cast<int>(level.chosen.size() + level.weak.size()));
    n_inside.push_back(static_cast<int>(level.inside.size()));
  }
  const std::vector<int> share = fit_to_available(budget, n_outside);
  const std::vector<int> share_inside = fit_to_available(budget_inside, n_inside);
  for (std::size_t i = 0; i < levels.size(); ++i) spread(i, share[i], share_inside[i]);
}

void OrbExtractor::Impl::spread(std::size_t i, int budget, int budget_inside) {
  LevelCorners& level = levels[i];
  if (level.all.empty()) return;
  const cv::Size size = picture(i).size();
  const cv::Rect region(kOrbBorderPx, kOrbBorderPx, size.width - 2 * kOrbBorderPx,
                        size.height - 2 * kOrbBorderPx);
  // Weak corners only make up what is short.
  quadtree.distribute(region, budget - static_cast<int>(level.chosen.size()), level.weak);
  quadtree.distribute(region, budget, level.chosen);
  quadtree.distribute(region, budget_inside, level.inside);
  level.chosen.insert(level.chosen.end(), level.weak.begin(), level.weak.end());
  level.chosen.insert(level.chosen.end(), level.inside.begin(), level.inside.end());
}

void OrbExtractor::Impl::describe(OrbFeatures& features) {
  for (int i = 0; i < pyramid.n_levels(); ++i) {
    const std::vector<Corner>& corners = levels[static_cast<std::size_t>(i)].chosen;
    if (corners.empty()) continue;
    const cv::Mat& level = pyramid.level(i);
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
}

}  // namespace cpslam
