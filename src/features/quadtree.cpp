#include "features/quadtree.h"

#include <algorithm>
#include <array>

namespace cpslam {

void Quadtree::distribute(const cv::Rect& region, int wanted, std::vector<Corner>& corners) {
  if (wanted <= 0) return corners.clear();
  if (corners.size() <= static_cast<std::size_t>(wanted)) return;
  const auto target = static_cast<std::size_t>(wanted);
  make_roots(region, corners);
  while (!pending_.empty() && leaves_.size() + pending_.size() < target) {
    // The order of creation breaks ties, so the result does not depend on the sort.
    std::stable_sort(pending_.begin(), pending_.end(),
                     [](const Node& a, const Node& b) { return a.count() > b.count(); });
    next_.clear();
    std::size_t done = 0;
    while (done < pending_.size() && leaves_.size() + next_.size() + pending_.size() - done < target) {
      split(pending_[done++], corners);
    }
    next_.insert(next_.end(), pending_.begin() + static_cast<std::ptrdiff_t>(done), pending_.end());
    pending_.swap(next_);
  }
  leaves_.insert(leaves_.end(), pending_.begin(), pending_.end());
  keep_strongest(corners);
  // The last split may have made up to three leaves too many: the weakest go.
  if (corners.size() > target) {
    std::stable_sort(corners.begin(), corners.end(),
                     [](const Corner& a, const Corner& b) { return a.response > b.response; });
    corners.resize(target);
  }
}

void Quadtree::make_roots(const cv::Rect& region, std::vector<Corner>& corners) {
  leaves_.clear();
  pending_.clear();
  const int longer = std::max(region.width, region.height);
  const int shorter = std::min(region.width, region.height);
  const int n = std::max(1, (longer + shorter / 2) / shorter);
  // Squares that cover the region both ways: a corner outside them could never be split off.
  const float size =
      std::max(static_cast<float>(longer) / static_cast<float>(n), static_cast<float>(shorter));
  const bool wide = region.width >= region.height;
  const auto root_of = [&](const Corner& c) {
    const int along = wide ? c.x - region.x : c.y - region.y;
    return std::min(static_cast<int>(static_cast<float>(along) / size), n - 1);
  };
  scratch_.clear();
  for (int i = 0; i < n; ++i) {
    const std::size_t begin = scratch_.size();
    for (const Corner& c : corners) {
      if (root_of(c) == i) scratch_.push_back(c);
    }
    const float offset = size * static_cast<float>(i);
    const Node node{static_cast<float>(region.x) + (wide ? offset : 0.0F),
                    static_cast<float>(region.y) + (wide ? 0.0F : offset), size, begin, scratch_.size()};
    if (node.count() > 1) pending_.push_back(node);
    if (node.count() == 1) leaves_.push_back(node);
  }
  corners.swap(scratch_);
}

void Quadtree::split(const Node& node, std::vector<Corner>& corners) {
  const float half = node.size * 0.5F;
  const float middle_x = node.x0 + half;
  const float middle_y = node.y0 + half;
  const auto quarter_of = [&](const Corner& c) {
    return (static_cast<float>(c.x) < middle_x ? 0U : 1U) + (static_cast<float>(c.y) < middle_y ? 0U : 2U);
  };
  std::array<std::size_t, 5> start{};  // of each quarter, and the end
  for (std::size_t i = node.begin; i < node.end; ++i) ++start[quarter_of(corners[i]) + 1];
  start[0] = node.begin;
  for (std::size_t q = 1; q < 5; ++q) start[q] += start[q - 1];
  if (scratch_.size() < corners.size()) scratch_.resize(corners.size());
  std::array<std::size_t, 4> put{start[0], start[1], start[2], start[3]};
  for (std::size_t i = node.begin; i < node.end; ++i) scratch_[put[quarter_of(corners[i])]++] = corners[i];
  std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(node.begin),
            scratch_.begin() + static_cast<std::ptrdiff_t>(node.end),
            corners.begin() + static_cast<std::ptrdiff_t>(node.begin));
  for (std::size_t q = 0; q < 4; ++q) {
    const Node child{q % 2 == 0 ? node.x0 : middle_x, q < 2 ? node.y0 : middle_y, half, start[q],
                     start[q + 1]};
    // Corners at the same pixel, which no detector gives, could be split for ever.
    const bool divisible = child.count() > 1 && half > 0.5F;
    if (divisible) next_.push_back(child);
    if (!divisible && child.count() > 0) leaves_.push_back(child);
  }
}

void Quadtree::keep_strongest(std::vector<Corner>& corners) {
  scratch_.clear();
  for (const Node& leaf : leaves_) {
    const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(leaf.begin);
    const auto end = corners.begin() + static_cast<std::ptrdiff_t>(leaf.end);
    // max_element returns the first of equals, and splitting kept raster order within a leaf.
    scratch_.push_back(*std::max_element(
        begin, end, [](const Corner& a, const Corner& b) { return a.response < b.response; }));
  }
  corners.swap(scratch_);
}

}  // namespace cpslam
