#pragma once

#include <array>

namespace cpslam::sim {

/// Where a pixel is probed for visible surfaces, px from its centre: the centre itself, which also gives the
/// depth, and three around it. Their mean is the centre, so edges do not move.
inline constexpr std::array<std::array<float, 2>, 4> kSampleOffsets{
    {{0.0F, 0.0F}, {0.1F, -0.4F}, {0.3F, 0.3F}, {-0.4F, 0.1F}}};

}  // namespace cpslam::sim
