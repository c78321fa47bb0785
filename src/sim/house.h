#pragma once

#include "sim/presets.h"
#include "sim/scene.h"

namespace cpslam::sim {

/// Builds and lights the place of a preset. Layout, colours and things depend on the seed, never on the
/// people.
[[nodiscard]] Scene build_scene(const PresetInfo& preset, Random& random);

}  // namespace cpslam::sim
