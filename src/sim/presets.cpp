#include "sim/presets.h"

#include "cpslam/error.h"

namespace cpslam::sim {

const std::vector<PresetInfo>& presets() {
  using enum PathKind;
  using enum PeopleKind;
  using enum PlaceKind;
  static const std::vector<PresetInfo> kPresets{
      {"office_static", "office, nobody there, camera nearly still", kOffice, kStatic, kNone, 0, 600},
      {"office_xyz", "office, nobody there, camera moved by +-0.5 m", kOffice, kXyz, kNone, 0, 600},
      {"office_rpy", "office, nobody there, camera turned by +-25 degrees", kOffice, kRpy, kNone, 0, 600},
      {"office_halfsphere", "office, nobody there, camera 1 m around the desk", kOffice, kHalfsphere, kNone,
       0, 600},
      {"office_rounds", "office, nobody there, camera carried round the desks, 23 s a round", kOffice,
       kRounds, kNone, 0, 1400},
      {"walking_static", "office, people walking, camera nearly still", kOffice, kStatic, kWalking, 3, 600},
      {"walking_xyz", "office, people walking, camera moved by +-0.5 m", kOffice, kXyz, kWalking, 3, 600},
      {"walking_rpy", "office, people walking, camera turned by +-25 degrees", kOffice, kRpy, kWalking, 3,
       600},
      {"walking_halfsphere", "office, people walking, camera 1 m around the desk", kOffice, kHalfsphere,
       kWalking, 3, 600},
      {"sitting_static", "office, people sitting, camera nearly still", kOffice, kStatic, kSitting, 2, 600},
      {"sitting_xyz", "office, people sitting, camera moved by +-0.5 m", kOffice, kXyz, kSitting, 2, 600},
      {"sitting_rpy", "office, people sitting, camera turned by +-25 degrees", kOffice, kRpy, kSitting, 2,
       600},
      {"sitting_halfsphere", "office, people sitting, camera 1 m around the desk", kOffice, kHalfsphere,
       kSitting, 2, 600},
      {"ring", "through six rooms and back to the start", kRing, kRingTour, kNone, 0, 1650},
      {"ring_walking", "through six rooms where people walk, and back to the start", kRing, kRingTour,
       kWalking, 4, 1650},
      {"twin_desks", "to and fro between two identical desks in one room", kTwinRoom, kTwins, kNone, 0, 960},
  };
  return kPresets;
}

const PresetInfo& find_preset(const std::string& name) {
  std::string names;
  for (const PresetInfo& preset : presets()) {
    if (preset.name == name) return preset;
    names += (names.empty() ? "" : ", ") + preset.name;
  }
  throw InputError("no preset is called '" + name + "'; there are: " + names);
}

}  // namespace cpslam::sim
