#include "diagnosis/edge_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/depth_edges.h"

namespace cpslam::diagnosis {
namespace {

constexpr double kRangeShare = 0.05;  // of the picture's width

int range_for(cv::Size size) {
  return std::max(4, static_cast<int>(std::lround(kRangeShare * size.width)));
}

}  // namespace

EdgeComparison::EdgeComparison(const cv::Mat& grey, const cv::Mat& readings) : size_(grey.size()) {
  DepthEdges depth = find_depth_edges(readings);
  depth_across_ = std::move(depth.across);
  depth_down_ = std::move(depth.down);
  const ColourEdges colour = find_colour_edges(grey);
  colour_across_ = colour.across;
  colour_down_ = colour.down;
}

AgreementMap EdgeComparison::make_map(cv::Size size) {
  return AgreementMap(range_for(size));
}

void EdgeComparison::add_to(AgreementMap& map, double growth) const {
  const int range = map.range_px();
  const cv::Rect inside(range, range, size_.width - 2 * range, size_.height - 2 * range);
  const auto enlarged = [growth](int place, int size) {
    const double middle = 0.5 * (size - 1);
    return static_cast<int>(std::lround(middle + (place - middle) * (1.0 + growth)));
  };
  const auto compare = [&](const std::vector<cv::Point>& edges, const cv::Mat& strength) {
    for (const cv::Point& edge : edges) {
      const cv::Point at(enlarged(edge.x, size_.width), enlarged(edge.y, size_.height));
      if (inside.contains(at))
        map.add_edge(strength.ptr<float>(at.y - range) + at.x - range, strength.step1());
    }
  };
  compare(depth_across_, colour_across_);
  compare(depth_down_, colour_down_);
}

}  // namespace cpslam::diagnosis
