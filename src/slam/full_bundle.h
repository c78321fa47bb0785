#pragma once

#include <atomic>
#include <optional>

#include "map/map.h"
#include "slam/bundle_snapshot.h"
#include "slam/rig.h"

namespace cpslam {

/// A bundle adjustment of the whole map, done and not written back yet.
struct FullBundle {
  BundleSnapshot snapshot;  ///< adjusted
  BundleResult result;
};

/// Bundle adjustment of the whole map but for the roots of its sessions, which hold the gauge. Works on a
/// snapshot: the map is only locked, shared, to copy it, and may grow and change meanwhile. Nothing when the
/// flag was raised before the end, or with fewer than two keyframes.
[[nodiscard]] std::optional<FullBundle> adjust_full_bundle(const Rig& rig, const Map& map,
                                                           const std::atomic<bool>& abort);

/// Writes the result into the map as it is by now (see apply_correction()), and removes the observations that
/// are outliers. The caller holds a unique lock of the map, and nobody is at work on an older copy of it.
void write_back(Map& map, const FullBundle& bundle);

}  // namespace cpslam
