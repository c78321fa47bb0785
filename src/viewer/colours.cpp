#include "viewer/colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cpslam::viewer {
namespace {

constexpr std::array<Colour, 5> kHeights{
    {{88, 80, 170}, {62, 120, 190}, {60, 170, 165}, {150, 200, 130}, {245, 222, 150}}};

std::uint8_t between(std::uint8_t a, std::uint8_t b, double share) {
  return static_cast<std::uint8_t>(std::lround((1.0 - share) * a + share * b));
}

}  // namespace

Colour height_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(kHeights.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kHeights.size() - 2);
  const double rest = at - static_cast<double>(below);
  const Colour& a = kHeights[below];
  const Colour& b = kHeights[below + 1];
  return {between(a.red, b.red, rest), between(a.green, b.green, rest), between(a.blue, b.blue, rest), 255};
}

}  // namespace cpslam::viewer
