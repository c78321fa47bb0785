// What OrbExtractor does where people are expected.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpslam/error.h"
#include "extraction_support.h"

namespace cpslam {
namespace {

using namespace test;

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

TEST(ExtractionPrior, RealFramesCoveredBySevenTenthsKeepTheirBudget) {
  const std::vector<cv::Mat> frames = test::desk_frames(25);
  if (frames.empty())
    GTEST_SKIP() << "no clip fr1_desk_dev: set CPSLAM_SHARED_DATA to the folder that holds it";
  const cv::Mat mask = coarse_mask({96, 0, 448, 480});
  for (const cv::Mat& frame : frames) {
    const OrbFeatures features = extract(frame, {.people = mask});
    EXPECT_EQ(n_outside(features, mask), std::min(1000, n_corners_outside(frame, mask)));
    EXPECT_LE(n_inside(features, mask), 150);
  }
}

TEST(ExtractionPrior, WhatPeopleWearChangesNothingOutside) {
  // Faint texture with a few strong patches; on the people's place a bright pattern, or nothing.
  const cv::Rect people(200, 80, 240, 320);
  const cv::Rect clothes(206, 86, 228, 308);  // out of reach of FAST from outside, not of its cells
  cv::Mat plain = faint_image(14, 0.15);
  textured_image(kSize.width, 80, 15).copyTo(plain.rowRange(0, 80));
  cv::Mat dressed = plain.clone();
  cv::Mat bare = plain.clone();
  noise_image(clothes.width, clothes.height, 16).copyTo(dressed(clothes));
  bare(clothes).setTo(100);
  OrbSettings settings;
  settings.n_levels = 1;
  settings.n_features = 250;
  const auto outside = [&](const cv::Mat& image) {
    OrbFeatures features;
    OrbExtractor(settings).extract(image, features, {.people = coarse_mask(people), .n_on_people = 0});
    return features;
  };
  ASSERT_EQ(outside(bare).keypoints.size(), 250U);
  // Their descriptors may differ: those look farther.
  const OrbFeatures a = outside(dressed);
  const OrbFeatures b = outside(bare);
  EXPECT_TRUE(std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), b.keypoints.end(),
                         [](const OrbKeypoint& k, const OrbKeypoint& l) {
                           return k.x == l.x && k.y == l.y && k.response == l.response;
                         }));
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
