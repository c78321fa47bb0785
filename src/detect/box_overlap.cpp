#include "detect/box_overlap.h"

#include <algorithm>

namespace cpslam {
namespace {

double area(const PersonBox& box) {
  return std::max(box.width, 0.0) * std::max(box.height, 0.0);
}

}  // namespace

float box_overlap(const PersonBox& a, const PersonBox& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  if (width <= 0.0 || height <= 0.0) return 0.0F;
  const double common = width * height;
  return static_cast<float>(common / (area(a) + area(b) - common));
}

}  // namespace cpslam
