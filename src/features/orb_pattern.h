#pragma once

#include <array>
#include <cstdint>

namespace cpslam {

/// One test of the descriptor: is the blurred patch darker at (x0, y0) than at (x1, y1)? Pixels relative to
/// the keypoint, before the rotation to its orientation.
struct PatternPair {
  std::int8_t x0, y0, x1, y1;
};

inline constexpr int kPatternPairs = 256;

/// The learned test pattern published with ORB (Rublee et al. 2011): all public ORB vocabularies are built on
/// it. No point is further than 18.4 px from the keypoint.
extern const std::array<PatternPair, kPatternPairs> kOrbPattern;

}  // namespace cpslam
