#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

int pick(Random& random, int n) {
  return static_cast<int>(random.index(static_cast<std::size_t>(n)));
}

void soften(cv::Mat& image) {
  cv::GaussianBlur(image, image, {3, 3}, 0.6);
}

}  // namespace

cv::Mat paint_door(Random& random) {
  const cv::Scalar base = random.uniform() < 0.5 ? cv::Scalar(120, 160, 190) : cv::Scalar(205, 210, 212);
  cv::Mat image = shaded(base, smooth_field({256, 512}, 60, random), 2.0);
  for (int j = 0; j < 2; ++j) {
    const cv::Rect panel(40, 40 + 230 * j, 176, 190 + 10 * j);
    cv::rectangle(image, panel, base * 0.8, 4, cv::LINE_AA);
    cv::rectangle(image, {panel.x + 5, panel.y + 5, panel.width, panel.height}, base * 1.08, 2, cv::LINE_AA);
  }
  cv::rectangle(image, {222, 256, 18, 40}, {150, 150, 150}, cv::FILLED);
  cv::line(image, {200, 268}, {232, 268}, {90, 90, 95}, 6, cv::LINE_AA);
  cv::rectangle(image, {0, 0, 256, 512}, base * 0.6, 5);
  soften(image);
  return image;
}

cv::Mat paint_window_view(Random& random) {
  cv::Mat image(384, 512, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) image.row(y).setTo(cv::Scalar(252, 240 - y / 12.0, 225 - y / 8.0));
  for (int i = 0; i < 5; ++i) {
    const cv::Rect house(pick(random, 430), 130 + pick(random, 120), 70 + pick(random, 60), 260);
    const cv::Rect inside = house & cv::Rect(0, 0, image.cols, image.rows);
    cv::rectangle(image, inside, random_colour(random, 130, 200), cv::FILLED);
    for (int y = inside.y + 14; y + 14 < image.rows; y += 32)
      for (int x = inside.x + 10; x + 12 < inside.x + inside.width; x += 24)
        cv::rectangle(image, {x, y, 11, 15}, {110, 100, 90}, cv::FILLED);
  }
  for (int i = 0; i < 7; ++i)
    cv::circle(image, {pick(random, 512), 330 + pick(random, 50)}, 24 + pick(random, 26), {70, 130, 80},
               cv::FILLED, cv::LINE_AA);
  cv::GaussianBlur(image, image, {5, 5}, 1.4);
  return image;
}

cv::Mat paint_keyboard(Random& random) {
  const bool dark = random.uniform() < 0.7;
  const cv::Scalar body = dark ? cv::Scalar(38, 36, 36) : cv::Scalar(200, 203, 204);
  const cv::Scalar key = dark ? cv::Scalar(66, 63, 62) : cv::Scalar(232, 234, 234);
  const cv::Scalar ink = dark ? cv::Scalar(200, 200, 200) : cv::Scalar(70, 70, 70);
  cv::Mat image(176, 512, CV_8UC3, body);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 19; ++column) {
      if (column == 15 || (row == 5 && column >= 4 && column <= 9)) continue;
      const cv::Rect cap(10 + 26 * column, 8 + 28 * row, 22, 22);
      cv::rectangle(image, cap, key, cv::FILLED);
      const std::string letter(1, static_cast<char>('A' + pick(random, 26)));
      cv::putText(image, letter, {cap.x + 6, cap.y + 15}, cv::FONT_HERSHEY_SIMPLEX, 0.4, ink, 1, cv::LINE_AA);
    }
  }
  cv::rectangle(image, {114, 148, 152, 22}, key, cv::FILLED);
  soften(image);
  return image;
}

cv::Mat paint_drawers(const cv::Scalar& bgr, int n_drawers, Random& random) {
  cv::Mat image = shaded(bgr, smooth_field({256, 384}, 90, random), 2.5);
  for (int i = 0; i < n_drawers; ++i) {
    const int height = image.rows / n_drawers;
    const cv::Rect drawer(8, i * height + 6, 240, height - 12);
    cv::rectangle(image, drawer, bgr * 0.62, 3, cv::LINE_AA);
    cv::rectangle(image, {98, drawer.y + drawer.height / 4, 60, 9}, {90, 92, 92}, cv::FILLED);
    if (random.uniform() < 0.5)
      cv::rectangle(image, {104, drawer.y + drawer.height / 2, 46, 18}, {235, 238, 240}, cv::FILLED);
  }
  soften(image);
  return image;
}

cv::Mat paint_radiator() {
  cv::Mat image(256, 512, CV_8UC3);
  for (int x = 0; x < image.cols; ++x) {
    const double shade = 205.0 + 22.0 * std::cos(2.0 * std::numbers::pi * x / 32.0);
    image.col(x).setTo(cv::Scalar(shade, shade, shade));
  }
  return image;
}

cv::Mat paint_clock() {
  cv::Mat image(256, 256, CV_8UC3, cv::Scalar(50, 50, 52));
  const cv::Point centre(128, 128);
  cv::circle(image, centre, 112, {244, 245, 245}, cv::FILLED, cv::LINE_AA);
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6.0;
    const cv::Point2d out(std::sin(angle), -std::cos(angle));
    cv::line(image, centre + cv::Point(out * 86.0), centre + cv::Point(out * 104.0), {30, 30, 30},
             i % 3 == 0 ? 7 : 3, cv::LINE_AA);
  }
  cv::line(image, centre, {168, 88}, {20, 20, 20}, 7, cv::LINE_AA);
  cv::line(image, centre, {96, 60}, {20, 20, 20}, 5, cv::LINE_AA);
  return image;
}

cv::Mat paint_mug(Random& random) {
  cv::Mat image(128, 256, CV_8UC3, random_colour(random, 60, 240));
  const cv::Scalar second = random_colour(random, 20, 240);
  cv::rectangle(image, {0, 20 + pick(random, 20), 256, 12}, second, cv::FILLED);
  for (int i = 0; i < 4; ++i)
    cv::circle(image, {32 + 64 * i, 84}, 16, second, i % 2 == 0 ? cv::FILLED : 5, cv::LINE_AA);
  soften(image);
  return image;
}

}  // namespace cpslam::sim
