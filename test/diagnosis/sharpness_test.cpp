#include "diagnosis/sharpness.h"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "diagnosis/findings.h"
#include "util/random.h"

namespace cpslam::diagnosis {
namespace {

/// Rectangles of all sizes and shades.
cv::Mat sharp_picture(std::uint64_t seed) {
  Random random(seed);
  cv::Mat picture(480, 640, CV_8UC1, cv::Scalar(120));
  for (int i = 0; i < 300; ++i) {
    const cv::Point at(static_cast<int>(random.index(640)), static_cast<int>(random.index(480)));
    const cv::Size size(4 + static_cast<int>(random.index(80)), 4 + static_cast<int>(random.index(80)));
    cv::rectangle(picture, cv::Rect(at, size), cv::Scalar(random.uniform(20.0, 235.0)), cv::FILLED);
  }
  return picture;
}

cv::Mat blurred(const cv::Mat& picture, cv::Size kernel) {
  cv::Mat result;
  cv::blur(picture, result, kernel);
  return result;
}

TEST(Blur, GrowsWithTheBlurInEitherDirection) {
  const cv::Mat sharp = sharp_picture(1);
  const double before = blur_of(sharp);
  EXPECT_LT(before, 0.2);
  for (const bool across : {true, false}) {
    double last = before;
    for (const int length_px : {3, 7, 15, 25}) {
      const double now = blur_of(blurred(sharp, across ? cv::Size(length_px, 1) : cv::Size(1, length_px)));
      EXPECT_GT(now, last) << length_px;
      last = now;
    }
    EXPECT_GT(last, 0.55);
  }
}

TEST(Blur, DoesNotDependOnContrast) {
  const cv::Mat sharp = sharp_picture(2);
  cv::Mat faint;
  sharp.convertTo(faint, CV_8U, 0.3, 80.0);
  EXPECT_NEAR(blur_of(faint), blur_of(sharp), 0.05);
}

TEST(Blur, OfAnEmptyWallIsWhole) {
  EXPECT_EQ(blur_of(cv::Mat(100, 100, CV_8UC1, cv::Scalar(90))), 1.0);
}

TEST(Sharpness, ShareOfBlurredFramesIsTold) {
  const cv::Mat sharp = sharp_picture(3);
  const cv::Mat smeared = blurred(sharp, {31, 1});
  const auto judge = [&](int n_sharp, int n_blurred) {
    SharpnessCheck check;
    ExaminedFrame frame;
    for (int i = 0; i < n_sharp + n_blurred; ++i) {
      frame.grey = i < n_sharp ? sharp : smeared;
      check.add(frame);
    }
    return check.findings();
  };
  EXPECT_EQ(worst_level(judge(20, 0)), Level::kOk);
  EXPECT_EQ(worst_level(judge(18, 2)), Level::kNote);
  EXPECT_NEAR(value_of(judge(18, 2), "sharpness", "blurred_share"), 0.1, 1e-9);
  EXPECT_EQ(worst_level(judge(12, 8)), Level::kWarning);
  const Findings unsharp = judge(0, 20);
  EXPECT_EQ(worst_level(unsharp), Level::kWarning);
  EXPECT_THAT(worst_of(unsharp, "sharpness").advice, testing::HasSubstr("lens"));
}

}  // namespace
}  // namespace cpslam::diagnosis
