#include "common/frame_painter.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace cpslam::program {
namespace {

using Pixel = cv::Vec3b;

constexpr int kWidth = 320, kHeight = 240;

cv::Mat grey_image() {
  return {kHeight, kWidth, CV_8UC3, cv::Scalar(100, 100, 100)};
}

bool is_greenish(const Pixel& pixel) {
  return pixel[1] > pixel[0] + 50 && pixel[1] > pixel[2] + 50;
}
bool is_red(const Pixel& pixel) {
  return pixel[2] > 200 && pixel[0] < 50 && pixel[1] < 50;
}

TEST(FramePainter, KeypointsHaveTheirColours) {
  FrameView view;
  view.keypoints = {{50.2F, 99.8F, FrameView::Kind::kKept},
                    {100.0F, 100.0F, FrameView::Kind::kTracked},
                    {150.0F, 100.0F, FrameView::Kind::kRemoved}};
  const cv::Mat picture = paint(grey_image(), view);
  ASSERT_EQ(picture.type(), CV_8UC3);
  const auto kept = picture.at<Pixel>(100, 50), tracked = picture.at<Pixel>(100, 100);
  EXPECT_TRUE(is_greenish(kept));
  EXPECT_TRUE(is_greenish(tracked));
  EXPECT_GT(tracked[1], kept[1] + 50);
  EXPECT_TRUE(is_red(picture.at<Pixel>(100, 150)));
  EXPECT_EQ(picture.at<Pixel>(100, 200), Pixel(100, 100, 100));
}

TEST(FramePainter, PeopleAreTintedAndToldApart) {
  FrameView view;
  view.person_mask = cv::Mat::zeros(kHeight, kWidth, CV_8UC1);
  view.person_mask(cv::Rect(100, 100, 20, 20)) = 1;
  view.person_mask(cv::Rect(200, 100, 20, 20)) = 2;
  view.person_mask(cv::Rect(250, 100, 20, 20)) = 255;
  const cv::Mat picture = paint(grey_image(), view);
  const Pixel nobody(100, 100, 100);
  EXPECT_EQ(picture.at<Pixel>(99, 110), nobody);
  EXPECT_EQ(picture.at<Pixel>(110, 120), nobody);
  EXPECT_NE(picture.at<Pixel>(110, 110), nobody);
  EXPECT_NE(picture.at<Pixel>(110, 210), nobody);
  EXPECT_NE(picture.at<Pixel>(110, 260), nobody);
  EXPECT_NE(picture.at<Pixel>(110, 110), picture.at<Pixel>(110, 210));
}

TEST(FramePainter, BoxesAreOutlinedEvenOverTheBorder) {
  FrameView view;
  view.boxes = {
      {100.0, 100.0, 60.0, 80.0, 0.87}, {-500.0, -500.0, 2000.0, 2000.0, 1.0}, {1e6, -1e6, 10.0, 10.0, 0.1}};
  view.boxes_time_s = 0.0;
  const cv::Mat image = grey_image();
  const cv::Mat picture = paint(image, view);
  EXPECT_NE(picture.at<Pixel>(100, 130), Pixel(100, 100, 100));
  EXPECT_NE(picture.at<Pixel>(140, 100), Pixel(100, 100, 100));
  EXPECT_EQ(picture.at<Pixel>(140, 130), Pixel(100, 100, 100)) << "inside";
  EXPECT_EQ(image.at<Pixel>(100, 130), Pixel(100, 100, 100)) << "the image itself is left alone";
}

TEST(FramePainter, OneChannelIsEnough) {
  FrameView view;
  view.keypoints = {{150.0F, 100.0F, FrameView::Kind::kRemoved}};
  const cv::Mat picture = paint(cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(80)), view);
  ASSERT_EQ(picture.type(), CV_8UC3);
  EXPECT_EQ(picture.at<Pixel>(200, 50), Pixel(80, 80, 80));
  EXPECT_TRUE(is_red(picture.at<Pixel>(100, 150)));
}

TEST(FramePainter, TheCaptionSaysWhatIsSeen) {
  // Another number, another picture; the rest of it stays.
  FrameView one, two;
  one.time_s = two.time_s = 5.0;
  one.boxes_time_s = 4.9;
  two.boxes_time_s = 4.5;
  cv::Mat difference;
  cv::absdiff(paint(grey_image(), one), paint(grey_image(), two), difference);
  const cv::Rect top(0, 0, kWidth, 20);
  EXPECT_GT(cv::sum(difference(top))[0], 0.0);
  EXPECT_EQ(cv::sum(difference(cv::Rect(0, 20, kWidth, kHeight - 20)))[0], 0.0);
}

}  // namespace
}  // namespace cpslam::program
