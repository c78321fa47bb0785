#include "features/orb_extractor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>

#include "cpslam/error.h"
#include "test_images.h"

namespace cpslam {
namespace {

OrbFeatures extract(const cv::Mat& image, const OrbSettings& settings = {}) {
  OrbFeatures features;
  OrbExtractor(settings).extract(image, features);
  return features;
}

void expect_equal(const OrbFeatures& a, const OrbFeatures& b) {
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  EXPECT_EQ(a.descriptors, b.descriptors);
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    EXPECT_EQ(a.keypoints[i].x, b.keypoints[i].x);
    EXPECT_EQ(a.keypoints[i].y, b.keypoints[i].y);
    EXPECT_EQ(a.keypoints[i].angle_deg, b.keypoints[i].angle_deg);
    EXPECT_EQ(a.keypoints[i].octave, b.keypoints[i].octave);
  }
}

/// Standard deviation of the keypoint counts of 8 x 6 cells over their mean.
template <typename Positions>
double unevenness(const Positions& positions, cv::Size size) {
  std::vector<double> counts(48, 0.0);
  for (const cv::Point2f& p : positions) {
    const int column = static_cast<int>(p.x * 8.0F / static_cast<float>(size.width));
    const int row = static_cast<int>(p.y * 6.0F / static_cast<float>(size.height));
    counts[static_cast<std::size_t>(row * 8 + column)] += 1.0;
  }
  const double mean = static_cast<double>(positions.size()) / 48.0;
  double squares = 0.0;
  for (const double c : counts) squares += (c - mean) * (c - mean);
  return std::sqrt(squares / 48.0) / mean;
}

std::vector<cv::Point2f> positions_of(const OrbFeatures& features) {
  std::vector<cv::Point2f> positions;
  for (const OrbKeypoint& k : features.keypoints) positions.emplace_back(k.x, k.y);
  return positions;
}

TEST(OrbExtractor, FillsTheBudgetOnTexturedPictures) {
  const OrbFeatures features = extract(test::textured_image(640, 480, 1));
  EXPECT_EQ(features.keypoints.size(), 1000U);
  EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
  // The budget of level i is proportional to 1.2^-i: 217 of 1000 on level 0, the rest of the rounding on
  // level 7.
  std::vector<int> counts(8, 0);
  for (const OrbKeypoint& k : features.keypoints) ++counts[static_cast<std::size_t>(k.octave)];
  EXPECT_EQ(counts, (std::vector<int>{217, 181, 151, 126, 105, 87, 73, 60}));
}

TEST(OrbExtractor, KeypointsKeepToTheBorderOfTheirLevel) {
  const OrbFeatures features = extract(test::textured_image(640, 480, 1));
  for (const OrbKeypoint& k : features.keypoints) {
    const double margin = 19.0 * std::pow(1.2, k.octave) - 1e-3;
    EXPECT_GE(k.x, margin);
    EXPECT_GE(k.y, margin);
    EXPECT_LE(k.x, 640.0 - margin);
    EXPECT_LE(k.y, 480.0 - margin);
  }
}

TEST(OrbExtractor, IsDeterministicAcrossCallsAndPictureSizes) {
  const cv::Mat image = test::textured_image(640, 480, 2);
  OrbExtractor extractor{OrbSettings{}};
  OrbFeatures first;
  OrbFeatures other;
  OrbFeatures second;
  extractor.extract(image, first);
  extractor.extract(test::textured_image(320, 200, 3), other);
  EXPECT_GT(other.keypoints.size(), 500U);
  extractor.extract(image, second);
  expect_equal(first, second);
  expect_equal(first, extract(image));
}

TEST(OrbExtractor, ViewsGiveWhatCopiesGive) {
  const cv::Mat whole = test::textured_image(700, 500, 4);
  const cv::Mat view = whole(cv::Rect(31, 7, 641, 479));
  ASSERT_FALSE(view.isContinuous());
  expect_equal(extract(view), extract(view.clone()));
}

TEST(OrbExtractor, BlackWhiteAndTinyPicturesHaveNoFeatures) {
  EXPECT_TRUE(extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(0))).keypoints.empty());
  EXPECT_TRUE(extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(255))).keypoints.empty());
  EXPECT_TRUE(extract(cv::Mat()).keypoints.empty());
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(38, 38), cv::Size(640, 20), cv::Size(7, 300)}) {
    EXPECT_TRUE(extract(test::noise_image(size.width, size.height, 5)).keypoints.empty()) << size;
  }
  EXPECT_FALSE(extract(test::noise_image(60, 60, 5)).keypoints.empty());
}

TEST(OrbExtractor, LowContrastStillGivesFeatures) {
  cv::Mat faint;
  test::textured_image(640, 480, 6).convertTo(faint, CV_8UC1, 0.12, 110.0);
  OrbSettings strict;
  strict.min_th_fast = strict.ini_th_fast;
  const std::size_t n = extract(faint).keypoints.size();
  EXPECT_GT(n, 500U);
  EXPECT_LT(extract(faint, strict).keypoints.size(), n / 2)
      << "the picture is not faint enough to show anything";
}

TEST(OrbExtractor, TurnedPicturesHaveTheSameFeatures) {
  const cv::Mat image = test::textured_image(480, 480, 7);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);  // (x, y) goes to (479 - y, x)
  OrbSettings settings;
  settings.n_levels = 1;
  const OrbFeatures a = extract(image, settings);
  const OrbFeatures b = extract(turned, settings);
  int n_common = 0;
  int n_alike = 0;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    for (std::size_t j = 0; j < b.keypoints.size(); ++j) {
      if (b.keypoints[j].x != 479.0F - a.keypoints[i].y || b.keypoints[j].y != a.keypoints[i].x) continue;
      ++n_common;
      const float turn = b.keypoints[j].angle_deg - a.keypoints[i].angle_deg;
      EXPECT_NEAR(std::remainder(turn - 90.0F, 360.0F), 0.0F, 0.05F);
      if (descriptor_distance(a.descriptors[i], b.descriptors[j]) <= 8) ++n_alike;
    }
  }
  EXPECT_GT(n_common, static_cast<int>(a.keypoints.size()) * 8 / 10);
  EXPECT_GT(n_alike, n_common * 95 / 100);
}

TEST(OrbExtractor, RefusesColour) {
  OrbFeatures features;
  OrbExtractor extractor{OrbSettings{}};
  EXPECT_THROW(extractor.extract(cv::Mat(480, 640, CV_8UC3), features), InputError);
  EXPECT_THROW(extractor.extract(cv::Mat(480, 640, CV_16UC1), features), InputError);
}

TEST(OrbExtractor, RealFramesAreFilledMoreEvenlyThanByOpenCv) {
  const std::vector<cv::Mat> frames = test::desk_frames(10);
  if (frames.empty())
    GTEST_SKIP() << "no clip fr1_desk_dev: set CPSLAM_SHARED_DATA to the folder that holds it";
  const auto orb = cv::ORB::create(1000, 1.2F, 8);
  double ours = 0.0;
  double theirs = 0.0;
  for (const cv::Mat& frame : frames) {
    const OrbFeatures features = extract(frame);
    EXPECT_GE(features.keypoints.size(), 950U);
    EXPECT_LE(features.keypoints.size(), 1000U);
    std::vector<cv::KeyPoint> keypoints;
    orb->detect(frame, keypoints);
    std::vector<cv::Point2f> positions;
    cv::KeyPoint::convert(keypoints, positions);
    ours += unevenness(positions_of(features), frame.size());
    theirs += unevenness(positions, frame.size());
  }
  RecordProperty("unevenness_ours", std::to_string(ours / static_cast<double>(frames.size())));
  RecordProperty("unevenness_opencv", std::to_string(theirs / static_cast<double>(frames.size())));
  EXPECT_LT(ours, theirs);
}

}  // namespace
}  // namespace cpslam
