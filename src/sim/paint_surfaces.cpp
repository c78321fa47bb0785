#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

constexpr int kSize = 512;

cv::Scalar scaled(const cv::Scalar& colour, double factor) {
  return {colour[0] * factor, colour[1] * factor, colour[2] * factor};
}

// Long, slightly wavy grain along x.
cv::Mat grain(cv::Size size, Random& random) {
  cv::Mat field(size, CV_32FC1);
  const cv::Mat bend = smooth_field(size, size.width / 4, random);
  const double phase = random.uniform(0.0, 100.0);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double across = y + 9.0 * static_cast<double>(bend.at<float>(y, x));
      const double turn = 2.0 * std::numbers::pi / size.height;
      field.at<float>(y, x) = static_cast<float>(0.5 * std::sin(7.0 * turn * across + phase) +
                                                 0.3 * std::sin(17.0 * turn * across + 2.3 * phase) +
                                                 0.2 * std::sin(31.0 * turn * across + 5.1 * phase));
    }
  }
  return field;
}

}  // namespace

cv::Mat smooth_field(cv::Size size, int cell_px, Random& random) {
  const cv::Size cells(std::max(2, size.width / cell_px), std::max(2, size.height / cell_px));
  cv::Mat coarse(cells, CV_32FC1);
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      coarse.at<float>(y, x) = static_cast<float>(random.uniform(-1.0, 1.0));
  constexpr int kBorder = 2;  // wraps around, so that the field tiles
  cv::Mat wrapped;
  cv::copyMakeBorder(coarse, wrapped, kBorder, kBorder, kBorder, kBorder, cv::BORDER_WRAP);
  const cv::Matx23d to_coarse(static_cast<double>(cells.width) / size.width, 0, kBorder, 0,
                              static_cast<double>(cells.height) / size.height, kBorder);
  cv::Mat field;
  cv::warpAffine(wrapped, field, to_coarse, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return field;
}

cv::Mat shaded(const cv::Scalar& base_bgr, const cv::Mat& field, double amplitude) {
  cv::Mat grey;
  field.convertTo(grey, CV_32FC1, amplitude);
  std::array<cv::Mat, 3> channels;
  for (std::size_t i = 0; i < 3; ++i) channels[i] = grey + base_bgr[static_cast<int>(i)];
  cv::Mat merged, image;
  cv::merge(channels.data(), channels.size(), merged);
  merged.convertTo(image, CV_8UC3);
  return image;
}

cv::Scalar random_colour(Random& random, double darkest, double brightest) {
  const double b = random.uniform(darkest, brightest);
  const double g = random.uniform(darkest, brightest);
  const double r = random.uniform(darkest, brightest);
  return {b, g, r};
}

cv::Mat paint_wall(const cv::Scalar& bgr, Random& random) {
  const cv::Size size(kSize, kSize);
  return shaded(bgr, smooth_field(size, 128, random) + 0.35 * smooth_field(size, 12, random), 1.6);
}

cv::Mat paint_carpet(const cv::Scalar& bgr, Random& random) {
  const cv::Size size(kSize, kSize);
  return shaded(bgr,
                0.5 * smooth_field(size, 64, random) + smooth_field(size, 5, random) +
                    0.8 * smooth_field(size, 2, random),
                4.5);
}

cv::Mat paint_floor_tiles(const cv::Scalar& bgr, Random& random) {
  cv::Mat image(kSize, kSize, CV_8UC3);
  constexpr int kTiles = 4;
  constexpr int kTile = kSize / kTiles;
  const cv::Mat mottle = smooth_field(image.size(), 20, random);
  for (int j = 0; j < kTiles; ++j) {
    for (int i = 0; i < kTiles; ++i) {
      const cv::Rect tile(i * kTile, j * kTile, kTile, kTile);
      shaded(scaled(bgr, random.uniform(0.97, 1.02)), mottle(tile), 3.0).copyTo(image(tile));
      cv::rectangle(image, tile, scaled(bgr, 0.78), 2, cv::LINE_AA);
    }
  }
  cv::GaussianBlur(image, image, {3, 3}, 0.7);
  return image;
}

cv::Mat paint_floor_planks(const cv::Scalar& bgr, Random& random) {
  cv::Mat image(kSize, kSize, CV_8UC3);
  constexpr int kPlanks = 6;
  for (int j = 0; j < kPlanks; ++j) {
    const int top = j * kSize / kPlanks;
    const cv::Rect plank(0, top, kSize, (j + 1) * kSize / kPlanks - top);
    shaded(scaled(bgr, random.uniform(0.9, 1.05)), grain(plank.size(), random), 6.0).copyTo(image(plank));
    cv::line(image, {0, top}, {kSize, top}, scaled(bgr, 0.6), 1, cv::LINE_AA);
    const int butt = static_cast<int>(random.index(kSize));
    cv::line(image, {butt, top}, {butt, top + plank.height}, scaled(bgr, 0.6), 1, cv::LINE_AA);
  }
  return image;
}

cv::Mat paint_ceiling(Random& random) {
  const cv::Size size(kSize, kSize);
  cv::Mat image = shaded({226, 228, 229}, smooth_field(size, 3, random), 1.5);
  for (int i = 0; i < 2; ++i) {
    const int at = i * kSize / 2;
    cv::line(image, {at, 0}, {at, kSize}, {196, 198, 198}, 3, cv::LINE_AA);
    cv::line(image, {0, at}, {kSize, at}, {196, 198, 198}, 3, cv::LINE_AA);
  }
  return image;
}

cv::Mat paint_wood(const cv::Scalar& bgr, Random& random) {
  return shaded(bgr, grain({kSize, kSize / 2}, random), 5.0);
}

cv::Mat paint_fabric(const cv::Scalar& bgr, Random& random) {
  const cv::Size size(256, 256);
  return shaded(bgr, smooth_field(size, 40, random) + 0.8 * smooth_field(size, 2, random), 5.0);
}

cv::Mat paint_rug(Random& random) {
  cv::Mat image(384, 512, CV_8UC3, random_colour(random, 50, 120));
  const cv::Scalar second = random_colour(random, 90, 200);
  const cv::Scalar third = random_colour(random, 40, 160);
  for (int i = 0; i < 3; ++i)
    cv::rectangle(image, {14 + 18 * i, 14 + 18 * i, 512 - 28 - 36 * i, 384 - 28 - 36 * i},
                  i == 1 ? third : second, 6);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) {
      const cv::Point centre(106 + 100 * i, 106 + 86 * j);
      cv::ellipse(image, centre, {30, 24}, 0, 0, 360, (i + j) % 2 == 0 ? second : third, cv::FILLED,
                  cv::LINE_AA);
      cv::ellipse(image, centre, {14, 10}, 45, 0, 360, (i + j) % 2 == 0 ? third : second, cv::FILLED,
                  cv::LINE_AA);
    }
  }
  const cv::Mat pile = shaded({0, 0, 0}, smooth_field(image.size(), 3, random) + 1.0, 5.0);
  cv::add(image, pile, image);
  cv::GaussianBlur(image, image, {3, 3}, 0.9);
  return image;
}

}  // namespace cpslam::sim
