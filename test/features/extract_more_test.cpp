// OrbExtractor's second look at an image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "extraction_support.h"

namespace cpslam {
namespace {

using namespace test;

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

}  // namespace
}  // namespace cpslam
