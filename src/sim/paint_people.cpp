#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

int pick(Random& random, int n) {
  return static_cast<int>(random.index(static_cast<std::size_t>(n)));
}

// Folds of cloth: soft, mostly vertical light and dark.
cv::Mat folds(cv::Size size, Random& random) {
  cv::Mat field = smooth_field({size.width, size.height / 3}, 26, random);
  cv::resize(field, field, size, 0, 0, cv::INTER_CUBIC);
  return field + 0.5 * smooth_field(size, 14, random);
}

void multiply_folds(cv::Mat& image, double strength, Random& random) {
  const cv::Mat field = folds(image.size(), random);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double factor = 1.0 + strength * static_cast<double>(field.at<float>(y, x));
      for (int i = 0; i < 3; ++i) {
        auto& value = image.at<cv::Vec3b>(y, x)[i];
        value = cv::saturate_cast<std::uint8_t>(factor * value);
      }
    }
  }
}

}  // namespace

cv::Mat paint_shirt(Random& random) {
  cv::Mat image(320, 512, CV_8UC3, random_colour(random, 30, 215));
  const cv::Scalar second = random_colour(random, 30, 235);
  switch (pick(random, 4)) {
    case 0:  // stripes around
      for (int y = 10; y < image.rows; y += 36) cv::rectangle(image, {0, y, 512, 14}, second, cv::FILLED);
      break;
    case 1:  // checks
      for (int y = 0; y < image.rows; y += 32) cv::rectangle(image, {0, y, 512, 6}, second, cv::FILLED);
      for (int x = 0; x < image.cols; x += 32) cv::rectangle(image, {x, 0, 6, 320}, second, cv::FILLED);
      break;
    case 2:  // a print on chest and back
      for (const int centre : {256, 0, 512}) {
        cv::circle(image, {centre, 110}, 44, second, cv::FILLED, cv::LINE_AA);
        cv::putText(image, random_word(random, 4, 6), {centre - 58, 190}, cv::FONT_HERSHEY_DUPLEX, 1.1,
                    second, 2, cv::LINE_AA);
      }
      break;
    default:  // buttons and a pocket
      cv::line(image, {256, 0}, {256, 320}, second * 0.7, 3, cv::LINE_AA);
      for (int y = 20; y < 320; y += 42) cv::circle(image, {262, y}, 4, second, cv::FILLED, cv::LINE_AA);
      cv::rectangle(image, {292, 70, 46, 52}, second * 0.8, 3, cv::LINE_AA);
      break;
  }
  multiply_folds(image, 0.10, random);
  cv::GaussianBlur(image, image, {3, 3}, 0.8);
  return image;
}

cv::Mat paint_trousers(Random& random) {
  const double tone = random.uniform(35, 130);
  cv::Mat image(320, 256, CV_8UC3,
                cv::Scalar(tone * random.uniform(1.0, 1.6), tone, tone * random.uniform(0.7, 1.0)));
  cv::line(image, {64, 0}, {64, 320}, cv::Scalar(tone, tone, tone) * 0.6, 2, cv::LINE_AA);
  cv::line(image, {192, 0}, {192, 320}, cv::Scalar(tone, tone, tone) * 0.6, 2, cv::LINE_AA);
  multiply_folds(image, 0.14, random);
  cv::GaussianBlur(image, image, {3, 3}, 0.8);
  return image;
}

cv::Mat paint_head(const cv::Scalar& skin_bgr, Random& random) {
  constexpr int kFront = 256;  // u = 0.5 looks forward
  cv::Mat image = shaded(skin_bgr, smooth_field({512, 320}, 60, random), 4.0);
  const cv::Scalar hair =
      random.uniform() < 0.3 ? cv::Scalar(70, 120, 160) : cv::Scalar(24, 30, 40) * random.uniform(0.6, 2.0);
  cv::rectangle(image, {0, 0, 512, 105}, hair, cv::FILLED);
  const int length = 180 + pick(random, 100);
  cv::rectangle(image, {0, 0, 150, length}, hair, cv::FILLED);
  cv::rectangle(image, {362, 0, 150, length}, hair, cv::FILLED);
  for (const int side : {-1, 1}) {
    cv::ellipse(image, {kFront + 34 * side, 158}, {13, 7}, 0, 0, 360, {235, 235, 235}, cv::FILLED,
                cv::LINE_AA);
    cv::circle(image, {kFront + 34 * side, 158}, 6, {50, 45, 40}, cv::FILLED, cv::LINE_AA);
    cv::line(image, {kFront + 20 * side, 140}, {kFront + 50 * side, 138}, hair, 5, cv::LINE_AA);
  }
  cv::line(image, {kFront, 160}, {kFront - 8, 204}, skin_bgr * 0.8, 4, cv::LINE_AA);
  cv::ellipse(image, {kFront, 234}, {24, 6}, 0, 0, 360, {90, 90, 170}, cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(image, image, {5, 5}, 1.2);
  return image;
}

cv::Mat paint_skin(const cv::Scalar& skin_bgr, Random& random) {
  return shaded(skin_bgr, smooth_field({128, 128}, 24, random), 5.0);
}

}  // namespace cpslam::sim
