#pragma once

#include <string>
#include <vector>

#include "sim/camera_path.h"

namespace cpslam::sim {

enum class PlaceKind { kOffice, kRing, kTwinRoom };
enum class PeopleKind { kNone, kWalking, kSitting };

/// A named kind of sequence.
struct PresetInfo {
  std::string name;
  std::string description;
  PlaceKind place = PlaceKind::kOffice;
  PathKind path = PathKind::kStatic;
  PeopleKind people = PeopleKind::kNone;
  int n_people = 0;  ///< unless the options say otherwise
  int n_frames = 0;  ///< unless the options say otherwise
};

[[nodiscard]] const std::vector<PresetInfo>& presets();

/// Throws InputError naming the preset and those there are.
[[nodiscard]] const PresetInfo& find_preset(const std::string& name);

}  // namespace cpslam::sim
