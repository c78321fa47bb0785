#include "detect/letterbox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "util/random.h"

namespace cpslam {
namespace {

TEST(Letterbox, CentresAndPadsWithGrey) {
  const Letterbox box({640, 480}, {416, 416});
  EXPECT_EQ(box.content(), cv::Rect(0, 52, 416, 312));
  const cv::Mat fitted = box.fit(cv::Mat(480, 640, CV_8UC3, cv::Scalar(1.0, 2.0, 3.0)));
  ASSERT_EQ(fitted.size(), cv::Size(416, 416));
  EXPECT_EQ(fitted.at<cv::Vec3b>(51, 200), cv::Vec3b(114, 114, 114));
  EXPECT_EQ(fitted.at<cv::Vec3b>(52, 0), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(fitted.at<cv::Vec3b>(363, 415), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(fitted.at<cv::Vec3b>(364, 200), cv::Vec3b(114, 114, 114));
}

TEST(Letterbox, LeavesAnImageOfTheInputsSizeAlone) {
  cv::Mat image(96, 64, CV_8UC1);
  cv::randu(image, 0, 256);
  const Letterbox box(image.size(), image.size());
  EXPECT_EQ(cv::norm(box.fit(image), image, cv::NORM_INF), 0.0);
  const PersonBox same = box.to_image({-3.0, 4.5, 10.0, 20.0, 0.5});
  EXPECT_EQ(same.x, -3.0);
  EXPECT_EQ(same.y, 4.5);
  EXPECT_EQ(same.width, 10.0);
  EXPECT_EQ(same.height, 20.0);
  EXPECT_EQ(same.confidence, 0.5);
}

TEST(Letterbox, RoundTripsForEverySize) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const auto side = [&](int limit) {
      return 1 + static_cast<int>(random.index(static_cast<std::size_t>(limit)));
    };
    const cv::Size image(side(2000), side(2000));
    const cv::Size input(32 * side(19), 32 * side(19));
    const Letterbox box(image, input);
    const cv::Rect content = box.content();
    ASSERT_EQ(content & cv::Rect({}, input), content);
    ASSERT_GT(content.area(), 0);
    // It fills one side and is off the middle by at most half a px on the other.
    EXPECT_TRUE(content.width == input.width || content.height == input.height);
    EXPECT_LE(std::abs(2 * content.x + content.width - input.width), 1);
    EXPECT_LE(std::abs(2 * content.y + content.height - input.height), 1);
    const double scale = std::min(1.0 * input.width / image.width, 1.0 * input.height / image.height);
    EXPECT_LE(std::abs(content.width - std::max(1.0, image.width * scale)), 0.5 + 1e-9);
    EXPECT_LE(std::abs(content.height - std::max(1.0, image.height * scale)), 0.5 + 1e-9);
    // The whole content is the whole image.
    const PersonBox whole =
        box.to_image({1.0 * content.x, 1.0 * content.y, 1.0 * content.width, 1.0 * content.height, 1.0});
    EXPECT_NEAR(whole.x, 0.0, 1e-9);
    EXPECT_NEAR(whole.y, 0.0, 1e-9);
    EXPECT_NEAR(whole.width, image.width, 1e-9);
    EXPECT_NEAR(whole.height, image.height, 1e-9);
  }
}

TEST(Letterbox, FindsAPaintedRectangleAgain) {
  const cv::Rect painted(120, 300, 96, 64);
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(0.0));
  cv::rectangle(image, painted, 255.0, cv::FILLED);
  for (const cv::Size input :
       {cv::Size(416, 416), cv::Size(320, 256), cv::Size(608, 352), cv::Size(96, 608)}) {
    const Letterbox box(image.size(), input);
    const cv::Rect seen = cv::boundingRect(box.fit(image) > 150);
    const PersonBox back =
        box.to_image({1.0 * seen.x, 1.0 * seen.y, 1.0 * seen.width, 1.0 * seen.height, 1.0});
    const double cell_px = 640.0 / box.content().width;  // one px of the input
    EXPECT_NEAR(back.x, painted.x, cell_px);
    EXPECT_NEAR(back.y, painted.y, cell_px);
    EXPECT_NEAR(back.width, painted.width, 2.0 * cell_px);
    EXPECT_NEAR(back.height, painted.height, 2.0 * cell_px);
  }
}

}  // namespace
}  // namespace cpslam
