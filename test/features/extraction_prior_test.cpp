// What OrbExtractor does where people are expected, and on a second look at the same image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "cpslam/error.h"
#include "features/corner_detector.h"
#include "features/image_mask.h"
#include "features/image_pyramid.h"
#include "features/orb_extractor.h"
#include "test_images.h"

namespace cpslam {
namespace {

const cv::Size kSize(640, 480);

OrbFeatures extract(const cv::Mat& image, const ExtractionPrior& prior = {}) {
  OrbFeatures features;
  OrbExtractor(OrbSettings{}).extract(image, features, prior);
  return features;
}

bool same(const OrbKeypoint& a, const OrbKeypoint& b) {
  return a.x == b.x && a.y == b.y && a.angle_deg == b.angle_deg && a.response == b.response &&
         a.octave == b.octave;
}

void expect_equal(const OrbFeatures& a, const OrbFeatures& b) {
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  EXPECT_TRUE(std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), same));
  EXPECT_EQ(a.descriptors, b.descriptors);
}

/// Coarse mask of a rectangle, px.
cv::Mat coarse_mask(const cv::Rect& rectangle_px) {
  cv::Mat mask = cv::Mat::zeros(kSize.height / 4, kSize.width / 4, CV_8UC1);
  mask(cv::Rect(rectangle_px.x / 4, rectangle_px.y / 4, rectangle_px.width / 4, rectangle_px.height / 4))
      .setTo(255);
  return mask;
}

int n_inside(const OrbFeatures& features, const cv::Mat& mask) {
  const ImageMask m(mask, kSize);
  return static_cast<int>(std::count_if(features.keypoints.begin(), features.keypoints.end(),
                                        [&m](const OrbKeypoint& k) { return m.covers(k.x, k.y); }));
}

int n_outside(const OrbFeatures& features, const cv::Mat& mask) {
  return static_cast<int>(features.keypoints.size()) - n_inside(features, mask);
}

/// Corners outside the mask from min_th_fast on, over all levels.
int n_corners_outside(const cv::Mat& image, const cv::Mat& mask) {
  const OrbSettings settings;
  ImagePyramid pyramid(settings.scale_factor, settings.n_levels);
  pyramid.build(image);
  CornerDetector detector(settings.min_th_fast);
  std::vector<Corner> corners;
  const ImageMask m(mask, kSize);
  int n = 0;
  for (int i = 0; i < pyramid.n_levels(); ++i) {
    detector.detect(pyramid.level(i), corners);
    n += static_cast<int>(std::count_if(corners.begin(), corners.end(), [&](const Corner& c) {
      return m.empty() || !m.covers(static_cast<float>(c.x) * pyramid.scale(i),
                                    static_cast<float>(c.y) * pyramid.scale(i));
    }));
  }
  return n;
}

/// The contrast of a textured image scaled down: few corners reach the first threshold.
cv::Mat faint_image(std::uint64_t seed, double contrast) {
  cv::Mat faint;
  test::textured_image(kSize.width, kSize.height, seed).convertTo(faint, CV_8UC1, contrast, 100.0);
  return faint;
}

TEST(ExtractionPrior, NobodyIsNoPrior) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 1);
  const OrbFeatures plain = extract(image);
  expect_equal(extract(image, {.people = cv::Mat::zeros(kSize, CV_8UC1)}), plain);
  expect_equal(extract(image, {.people = cv::Mat::zeros(kSize.height / 4, kSize.width / 4, CV_8UC1),
                               .n_on_people = 7}),
               plain);
}

TEST(ExtractionPrior, LeavesNoTraceInTheNextImage) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 2);
  const cv::Mat mask = coarse_mask({160, 100, 300, 300});
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures first;
  OrbFeatures plain;
  OrbFeatures again;
  extractor.extract(image, first, {.people = mask});
  extractor.extract_more(mask, 100, first);
  extractor.extract(image, plain);
  expect_equal(plain, extract(image));
  extractor.extract(image, again, {.people = mask});
  expect_equal(again, extract(image, {.people = mask}));
}

TEST(ExtractionPrior, KeepsToBothBudgetsAndSpendsThem) {
  for (const std::uint64_t seed : {3U, 4U}) {
    const cv::Mat image = test::textured_image(kSize.width, kSize.height, seed);
    for (const cv::Rect& people :
         {cv::Rect(0, 0, 320, 480), cv::Rect(240, 40, 120, 440), cv::Rect(20, 20, 600, 440)}) {
      const cv::Mat mask = coarse_mask(people);
      for (const int extra : {0, 40, 150}) {
        const OrbFeatures features = extract(image, {.people = mask, .n_on_people = extra});
        EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
        EXPECT_EQ(n_inside(features, mask), extra) << people;
        EXPECT_EQ(n_outside(features, mask), std::min(1000, n_corners_outside(image, mask))) << people;
      }
    }
  }
}

TEST(ExtractionPrior, FullSizeAndCoarseMasksAgree) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 5);
  const cv::Rect people(200, 80, 160, 320);
  cv::Mat full = cv::Mat::zeros(kSize, CV_8UC1);
  full(people).setTo(1);
  expect_equal(extract(image, {.people = full}), extract(image, {.people = coarse_mask(people)}));
}

TEST(ExtractionPrior, ThreeTenthsOfTheImageGiveAllTheirCornersIfNeedBe) {
  bool some_short = false;
  bool some_full = false;
  for (const cv::Rect& people : {cv::Rect(0, 0, 448, 480), cv::Rect(96, 0, 448, 480)}) {
    const cv::Mat mask = coarse_mask(people);
    for (const double contrast : {1.0, 0.3, 0.15}) {
      const cv::Mat image = faint_image(6, contrast);
      const int there = n_corners_outside(image, mask);
      const int reachable = std::min(1000, there);
      EXPECT_EQ(n_outside(extract(image, {.people = mask}), mask), reachable) << people << contrast;
      EXPECT_LT(n_outside(extract(image), mask), reachable * 6 / 10) << "the prior is not needed here";
      some_short = some_short || (there < 1000 && there > 100);
      some_full = some_full || there > 1000;
    }
  }
  EXPECT_TRUE(some_short);
  EXPECT_TRUE(some_full);
}

TEST(ExtractionPrior, FeaturesOutsideAreSpreadAsEverAndCarryTheSameDescriptors) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 7);
  const cv::Mat mask = coarse_mask({0, 0, 448, 480});
  const OrbFeatures plain = extract(image);
  const OrbFeatures features = extract(image, {.people = mask});
  const ImageMask m(mask, kSize);
  std::size_t n_common = 0;
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    for (std::size_t j = 0; j < plain.keypoints.size(); ++j) {
      if (!same(features.keypoints[i], plain.keypoints[j])) continue;
      ++n_common;
      EXPECT_EQ(features.descriptors[i], plain.descriptors[j]);
    }
  }
  EXPECT_GT(n_common, 100U);
  // No sixth of the free strip is left empty.
  std::vector<int> counts(6, 0);
  for (const OrbKeypoint& k : features.keypoints) {
    if (!m.covers(k.x, k.y)) ++counts[static_cast<std::size_t>(k.y / 80.0F)];
  }
  EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 60);
}

TEST(ExtractionPrior, RefusesMasksThatDoNotFit) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 8);
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures features;
  EXPECT_THROW(extractor.extract(image, features, {.people = cv::Mat::ones(240, 320, CV_8UC1)}), InputError);
  extractor.extract(image, features);
  EXPECT_THROW((void)extractor.extract_more(cv::Mat::ones(240, 320, CV_8UC1), 10, features), InputError);
}

TEST(ExtractMore, GivesNewFeaturesOutsideTheMaskOnly) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 9);
  const cv::Mat mask = coarse_mask({0, 0, 448, 480});
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures features;
  extractor.extract(image, features);
  const OrbFeatures before = features;
  const int n_added = extractor.extract_more(mask, 300, features);
  EXPECT_EQ(n_added, 300);
  ASSERT_EQ(features.keypoints.size(), before.keypoints.size() + 300);
  ASSERT_EQ(features.descriptors.size(), features.keypoints.size());
  const ImageMask m(mask, kSize);
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const OrbKeypoint& k = features.keypoints[i];
    if (i < before.keypoints.size()) {
      EXPECT_TRUE(same(k, before.keypoints[i]));
      EXPECT_EQ(features.descriptors[i], before.descriptors[i]);
      continue;
    }
    EXPECT_FALSE(m.covers(k.x, k.y));
    const float apart = 2.5F * static_cast<float>(std::pow(1.2, k.octave));
    for (const OrbKeypoint& other : before.keypoints) {
      if (other.octave != k.octave) continue;
      EXPECT_GT(std::max(std::abs(other.x - k.x), std::abs(other.y - k.y)), apart);
    }
  }
}

TEST(ExtractMore, DescribesAsExtractDoes) {
  // A budget that takes every corner there is, in one go and in two.
  const cv::Mat image = faint_image(10, 0.06);
  OrbSettings few;
  few.n_features = 100;
  OrbExtractor extractor{few};
  OrbFeatures features;
  extractor.extract(image, features);
  ASSERT_GT(extractor.extract_more({}, 10000, features), 100);
  const OrbFeatures all = extract(image, {.people = coarse_mask({0, 0, 4, 4})});  // nothing: in the border
  std::size_t n_found = 0;
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const auto it = std::find_if(all.keypoints.begin(), all.keypoints.end(),
                                 [&](const OrbKeypoint& k) { return same(k, features.keypoints[i]); });
    if (it == all.keypoints.end()) continue;
    ++n_found;
    EXPECT_EQ(features.descriptors[i], all.descriptors[static_cast<std::size_t>(it - all.keypoints.begin())]);
  }
  EXPECT_GT(n_found, 200U);
}

TEST(ExtractMore, ComesToAnEnd) {
  const cv::Mat image = faint_image(11, 0.3);
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures features;
  EXPECT_EQ(extractor.extract_more({}, 100, features), 0) << "there has been no image yet";
  extractor.extract(image, features);
  const std::size_t n = features.keypoints.size();
  EXPECT_EQ(extractor.extract_more({}, 0, features), 0);
  EXPECT_EQ(extractor.extract_more(cv::Mat(kSize, CV_8UC1, cv::Scalar(1)), 100, features), 0);
  const int n_added = extractor.extract_more({}, 100000, features);
  EXPECT_GT(n_added, 0);
  EXPECT_LE(static_cast<int>(n) + n_added, n_corners_outside(image, {}));
  EXPECT_EQ(extractor.extract_more({}, 100000, features), 0) << "the same corners came twice";
}

TEST(ExtractMore, IsDeterministic) {
  const cv::Mat image = test::textured_image(kSize.width, kSize.height, 12);
  const cv::Mat mask = coarse_mask({100, 100, 200, 200});
  const auto twice = [&] {
    OrbExtractor extractor{OrbSettings{}};
    OrbFeatures features;
    extractor.extract(image, features, {.people = mask});
    extractor.extract_more(mask, 250, features);
    return features;
  };
  expect_equal(twice(), twice());
}

TEST(ExtractionPrior, TinyPicturesAreNoTrouble) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(38, 38), cv::Size(60, 60), cv::Size(640, 20)}) {
    const cv::Mat image = test::noise_image(size.width, size.height, 13);
    OrbExtractor extractor{OrbSettings{}};
    OrbFeatures features;
    extractor.extract(image, features, {.people = cv::Mat(size, CV_8UC1, cv::Scalar(1))});
    EXPECT_LE(features.keypoints.size(), 150U);
    (void)extractor.extract_more({}, 50, features);
    EXPECT_EQ(features.keypoints.empty(), size.width != 60) << size;
  }
}

}  // namespace
}  // namespace cpslam
