#include "diagnosis/depth_edges.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace cpslam::diagnosis {
namespace {

constexpr float kJump = 1.12F;   // ratio of the depths beside an edge
constexpr int kWidestHole = 24;  // px between the two surfaces

/// Edges met on the way along a row or column. at(i) is the reading, add(i) takes the edge behind pixel i.
template <typename At, typename Add>
void walk(int n, const At& at, const Add& add) {
  int last = -1;
  for (int i = 0; i < n; ++i) {
    const float here = at(i);
    if (here <= 0.0F) continue;
    if (last >= 0 && i - last <= kWidestHole) {
      const float before = at(last);
      if (before > kJump * here) add(i - 1);
      if (here > kJump * before) add(last);
    }
    last = i;
  }
}

/// Strength between pixels that `neighbour` tells apart, on a slightly smoothed picture.
cv::Mat strength(const cv::Mat& smooth, cv::Point neighbour) {
  const cv::Rect here(0, 0, smooth.cols - neighbour.x, smooth.rows - neighbour.y);
  cv::Mat difference = cv::Mat::zeros(smooth.size(), CV_32FC1);
  cv::Mat inner = difference(here);
  cv::absdiff(smooth(here), smooth(here + neighbour), inner);
  const double mean = std::max(1e-3, cv::mean(difference)[0]);
  constexpr double kStrongest = 4.0;
  return cv::min(difference / mean, kStrongest);
}

}  // namespace

DepthEdges find_depth_edges(const cv::Mat& readings) {
  DepthEdges edges;
  for (int y = 0; y < readings.rows; ++y) {
    const auto* row = readings.ptr<float>(y);
    walk(
        readings.cols, [row](int x) { return row[x]; },
        [&edges, y](int x) { edges.across.emplace_back(x, y); });
  }
  const cv::Mat turned = readings.t();
  for (int x = 0; x < turned.rows; ++x) {
    const auto* column = turned.ptr<float>(x);
    walk(
        turned.cols, [column](int y) { return column[y]; },
        [&edges, x](int y) { edges.down.emplace_back(x, y); });
  }
  return edges;
}

ColourEdges find_colour_edges(const cv::Mat& grey) {
  cv::Mat smooth;
  grey.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {5, 5}, 1.0);
  return {strength(smooth, {1, 0}), strength(smooth, {0, 1})};
}

}  // namespace cpslam::diagnosis
