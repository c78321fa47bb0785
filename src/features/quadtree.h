#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "features/corner.h"

namespace cpslam {

/// Spreads corners evenly over a region (Mur-Artal et al. 2015): square root cells are split into quarters,
/// all of one size before any smaller one and the fullest first, until there are as many leaves as corners
/// wanted; every leaf keeps its strongest corner, the first in raster order among equals. Memory is kept
/// between calls.
class Quadtree {
 public:
  /// Replaces `corners` (raster order, inside `region`) by at most `wanted` of them.
  void distribute(const cv::Rect& region, int wanted, std::vector<Corner>& corners);

 private:
  struct Node {
    float x0, y0, size;      // square cell, px; may reach over the region
    std::size_t begin, end;  // range of corners
    [[nodiscard]] std::size_t count() const { return end - begin; }
  };
  void make_roots(const cv::Rect& region, std::vector<Corner>& corners);
  void split(const Node& node, std::vector<Corner>& corners);
  void keep_strongest(std::vector<Corner>& corners);

  std::vector<Node> leaves_;   // cells that will not be split any more
  std::vector<Node> pending_;  // cells of the current size that hold several corners
  std::vector<Node> next_;     // their children that hold several corners
  std::vector<Corner> scratch_;
};

}  // namespace cpslam
