#include "sim/house.h"

#include "sim/rooms.h"

namespace cpslam::sim {

Scene build_scene(const PresetInfo& preset, Random& random) {
  Scene scene;
  Furnisher furnisher(scene, paint_palette(scene.assets, random));
  switch (preset.place) {
    case PlaceKind::kOffice:
      build_office(scene, furnisher, preset.people == PeopleKind::kSitting, random);
      break;
    case PlaceKind::kRing:
      build_ring(scene, furnisher, random);
      break;
    case PlaceKind::kTwinRoom:
      build_twin_room(scene, furnisher, random);
      break;
  }
  scene.bake_light();
  return scene;
}

}  // namespace cpslam::sim
