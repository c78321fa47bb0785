#include "features/image_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cpslam/error.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

std::string complaint(const cv::Mat& colour, const cv::Mat& depth) {
  try {
    check_images(colour, depth, {640, 480});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

cv::Mat image(int type, int width = 640, int height = 480) {
  return cv::Mat::zeros(height, width, type);
}

TEST(ImageCheck, TakesEveryDocumentedType) {
  for (const int colour : {CV_8UC3, CV_8UC1}) {
    for (const int depth : {CV_16UC1, CV_32FC1}) EXPECT_EQ(complaint(image(colour), image(depth)), "");
  }
}

TEST(ImageCheck, SaysWhatIsWrong) {
  const cv::Mat colour = image(CV_8UC3);
  const cv::Mat depth = image(CV_16UC1);
  EXPECT_THAT(complaint({}, depth), HasSubstr("colour image is empty"));
  EXPECT_THAT(complaint(colour, {}), HasSubstr("depth image is empty"));
  EXPECT_THAT(complaint(image(CV_8UC4), depth), HasSubstr("colour image must have 8 bits"));
  EXPECT_THAT(complaint(image(CV_16UC3), depth), HasSubstr("colour image must have 8 bits"));
  EXPECT_THAT(complaint(colour, image(CV_8UC1)), HasSubstr("depth image must have 16-bit"));
  EXPECT_THAT(complaint(colour, image(CV_64FC1)), HasSubstr("depth image must have 16-bit"));
  EXPECT_THAT(complaint(colour, image(CV_16UC1, 320, 240)),
              testing::AllOf(HasSubstr("640x480"), HasSubstr("320x240"), HasSubstr("registered")));
  EXPECT_THAT(complaint(image(CV_8UC3, 320, 240), image(CV_16UC1, 320, 240)),
              testing::AllOf(HasSubstr("320x240"), HasSubstr("Camera.width"), HasSubstr("640x480")));
}

}  // namespace
}  // namespace cpslam
