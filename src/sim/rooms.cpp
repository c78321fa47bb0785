#include "sim/rooms.h"

#include <cmath>
#include <numbers>

namespace cpslam::sim {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;

RoomSpec random_spec(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const Palette& palette,
                     Random& random) {
  RoomSpec spec;
  spec.area.extend(low);
  spec.area.extend(high);
  spec.floor = palette.floors[random.index(palette.floors.size())];
  spec.wall = palette.walls[random.index(palette.walls.size())];
  return spec;
}

// One piece of furniture, about 1.6 m wide, with what hangs above it.
void furnish_slot(Furnisher& furnisher, const SE3& place, bool outer_wall, Random& random) {
  switch (random.index(outer_wall ? 8 : 7)) {
    case 0:
      furnisher.bookshelf(place * placed({-0.42, 0, 0}), 0.82, 5, random);
      furnisher.bookshelf(place * placed({0.42, 0, 0}), 0.82, random.uniform() < 0.5 ? 5 : 3, random);
      break;
    case 1:
      furnisher.desk(place * placed({0, -0.42, 0}), 1.4, random);
      furnisher.office_chair(place * placed({random.uniform(-0.2, 0.2), -0.85, 0}, random.uniform(-0.5, 0.5)),
                             random);
      furnisher.notice_board(place, random);
      break;
    case 2:
      furnisher.cabinet(place * placed({-0.3, 0, 0}), {0.8, 0.4, random.uniform(0.7, 1.1)}, random);
      furnisher.poster(place * placed({-0.4, 0, 0}), 1.75, 0.45, random);
      furnisher.poster(place * placed({0.3, 0, 0}), 1.6, 0.55, random);
      furnisher.waste_bin(place * placed({0.4, -0.2, 0}));
      break;
    case 3:
      furnisher.sofa(place, random);
      furnisher.poster(place * placed({-0.5, 0, 0}), 1.6, 0.5, random);
      furnisher.poster(place * placed({0.4, 0, 0}), 1.65, 0.6, random);
      break;
    case 4:
      furnisher.whiteboard(place, random);
      furnisher.carton(place * placed({-0.4, -0.25, 0}, random.uniform(-0.3, 0.3)), random);
      furnisher.carton(place * placed({0.3, -0.22, 0}, random.uniform(-0.3, 0.3)), random);
      break;
    case 5:
      furnisher.closed_door(place * placed({-0.2, 0, 0}), random);
      furnisher.light_switch(place * placed({0.42, 0, 0}));
      furnisher.poster(place * placed({0.65, 0, 0}), 1.7, 0.38, random);
      break;
    case 6:
      furnisher.plant(place * placed({-0.5, -0.35, 0}), random);
      furnisher.poster(place * placed({0, 0, 0}), 1.5, 0.6, random);
      furnisher.poster(place * placed({0.65, 0, 0}), 1.5, 0.45, random);
      furnisher.wall_clock(place * placed({-0.45, 0, 0}), 2.1);
      break;
    default:
      furnisher.window(place, 1.4, random);
      break;
  }
}

// Furniture along all walls, wherever no doorway is near.
void furnish_walls(Furnisher& furnisher, const RoomSpec& spec, const std::vector<Wall>& outer_walls,
                   Random& random) {
  for (const Wall wall : {Wall::kNorth, Wall::kEast, Wall::kSouth, Wall::kWest}) {
    const bool along_x = wall == Wall::kNorth || wall == Wall::kSouth;
    const double length = along_x ? spec.area.sizes().x() : spec.area.sizes().y();
    constexpr double kCorner_m = 0.55;  // furniture of the next wall stands there
    const int n_slots = static_cast<int>((length - 2 * kCorner_m) / 1.7);
    const bool outer = std::find(outer_walls.begin(), outer_walls.end(), wall) != outer_walls.end();
    for (int i = 0; i < n_slots; ++i) {
      const double along = (i + 0.5 - 0.5 * n_slots) * (length - 2 * kCorner_m) / n_slots;
      bool blocked = false;
      for (const Doorway& doorway : spec.doorways)
        blocked |= doorway.wall == wall && std::abs(doorway.along_m - along) < 0.8 + 0.6 * doorway.width_m;
      if (blocked) continue;
      furnish_slot(furnisher, wall_place(spec.area, wall, along), outer, random);
    }
    for (const Doorway& doorway : spec.doorways) {
      if (doorway.wall != wall) continue;
      furnisher.light_switch(wall_place(spec.area, wall, doorway.along_m + 0.8));
      furnisher.poster(wall_place(spec.area, wall, doorway.along_m - 1.0), 1.6, 0.42, random);
      furnisher.poster(wall_place(spec.area, wall, doorway.along_m + 1.15), 1.6, 0.42, random);
    }
  }
}

}  // namespace

void build_office(Scene& scene, Furnisher& furnisher, bool end_chairs, Random& random) {
  using Plan = OfficePlan;
  const RoomSpec spec =
      random_spec({Plan::kWest, Plan::kSouth}, {Plan::kEast, Plan::kNorth}, furnisher.palette(), random);
  build_shell(scene, furnisher, spec);
  for (const double y : {2.0, 3.6}) {
    furnisher.desk(placed({3.1, y, 0}, -kQuarter), 1.6, random);
    furnisher.desk(placed({3.92, y, 0}, kQuarter), 1.6, random);
    furnisher.office_chair(
        placed({2.55, y + random.uniform(-0.15, 0.15), 0}, -kQuarter + random.uniform(-0.4, 0.4)), random);
    furnisher.office_chair(placed({4.62, y, 0}, kQuarter), random);
  }
  if (end_chairs) {
    furnisher.office_chair(placed({3.2, 0.72, 0}, 0.0), random);
    furnisher.office_chair(placed({3.8, 4.88, 0}, 2.0 * kQuarter), random);
  }
  const auto wall = [&](Wall which, double along) { return wall_place(spec.area, which, along); };
  // East, what the camera faces.
  furnisher.bookshelf(wall(Wall::kEast, -2.1), 0.9, 5, random);
  furnisher.bookshelf(wall(Wall::kEast, -1.15), 0.9, 5, random);
  furnisher.cabinet(wall(Wall::kEast, 1.0), {0.8, 0.42, 0.75}, random);
  furnisher.notice_board(wall(Wall::kEast, 0.0), random);
  furnisher.poster(wall(Wall::kEast, 1.1), 1.7, 0.6, random);
  furnisher.closed_door(wall(Wall::kEast, 2.1), random);
  furnisher.wall_clock(wall(Wall::kEast, 0.1), 2.3);
  // North: the windows' side.
  furnisher.window(wall(Wall::kNorth, -0.9), 1.7, random);
  furnisher.window(wall(Wall::kNorth, 1.3), 1.7, random);
  furnisher.poster(wall(Wall::kNorth, -2.6), 1.6, 0.6, random);
  furnisher.plant(wall(Wall::kNorth, 3.1) * placed({0, -0.4, 0}), random);
  furnisher.light_switch(wall(Wall::kNorth, 0.2));
  // South.
  furnisher.whiteboard(wall(Wall::kSouth, 0.9), random);
  furnisher.bookshelf(wall(Wall::kSouth, -2.4), 0.9, 4, random);
  furnisher.cabinet(wall(Wall::kSouth, -0.6), {0.8, 0.3, 1.1}, random);
  furnisher.poster(wall(Wall::kSouth, 2.4), 1.6, 0.7, random);
  furnisher.waste_bin(wall(Wall::kSouth, 1.8) * placed({0, -0.2, 0}));
  // West, behind the camera.
  furnisher.poster(wall(Wall::kWest, -1.7), 1.6, 0.6, random);
  furnisher.poster(wall(Wall::kWest, -0.8), 1.5, 0.5, random);
  furnisher.notice_board(wall(Wall::kWest, 0.6), random);
  furnisher.closed_door(wall(Wall::kWest, 2.0), random);
}

void build_ring(Scene& scene, Furnisher& furnisher, Random& random) {
  using Plan = RingPlan;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 3; ++i) {
      constexpr double kHalfWall_m = 0.5 * Plan::kWall_m;
      const Eigen::Vector2d corner(i * Plan::kCellX_m, j * Plan::kCellY_m);
      RoomSpec spec = random_spec(
          corner + Eigen::Vector2d::Constant(kHalfWall_m),
          corner + Eigen::Vector2d(Plan::kCellX_m, Plan::kCellY_m) - Eigen::Vector2d::Constant(kHalfWall_m),
          furnisher.palette(), random);
      std::vector<Wall> outer{j == 0 ? Wall::kSouth : Wall::kNorth};
      // Doorways lie towards the outside of the ring in the lower row, and the same passage in both its
      // rooms.
      const double door_y = j == 0 ? -Plan::kDoorOffset_m : Plan::kDoorOffset_m;
      if (i > 0) spec.doorways.push_back({Wall::kWest, door_y});
      if (i < 2) spec.doorways.push_back({Wall::kEast, -door_y});
      if (i == 0) outer.push_back(Wall::kWest);
      if (i == 2) outer.push_back(Wall::kEast);
      if (i != 1) spec.doorways.push_back({j == 0 ? Wall::kNorth : Wall::kSouth, 0.0});
      build_shell(scene, furnisher, spec);
      furnish_walls(furnisher, spec, outer, random);
      if (random.uniform() < 0.6)
        furnisher.rug(placed({spec.area.center().x(), spec.area.center().y(), 0}, random.uniform(-0.3, 0.3)),
                      random);
    }
  }
}

void build_twin_room(Scene& scene, Furnisher& furnisher, Random& random) {
  const RoomSpec spec =
      random_spec({0.0, 0.0}, {TwinPlan::kLength_m, TwinPlan::kDepth_m}, furnisher.palette(), random);
  build_shell(scene, furnisher, spec);
  const std::uint64_t twin_seed = random.next();
  for (const Wall wall : {Wall::kWest, Wall::kEast}) {
    Random twin(twin_seed);
    const SE3 place = wall_place(spec.area, wall, 0.0);
    furnisher.desk(place * placed({0, -0.45, 0}), 1.6, twin);
    furnisher.office_chair(place * placed({0.1, -1.0, 0}, 0.3), twin);
    furnisher.poster(place * placed({-0.45, 0, 0}), 1.75, 0.5, twin);
    furnisher.poster(place * placed({0.4, 0, 0}), 1.7, 0.6, twin);
    furnisher.bookshelf(place * placed({-1.45, 0, 0}), 0.9, 4, twin);
    furnisher.cabinet(place * placed({1.45, 0, 0}), {0.8, 0.4, 0.9}, twin);
    furnisher.poster(place * placed({1.4, 0, 0}), 1.65, 0.5, twin);
  }
  for (const double along : {-2.4, 0.0, 2.4}) {
    furnish_slot(furnisher, wall_place(spec.area, Wall::kNorth, along), true, random);
    furnish_slot(furnisher, wall_place(spec.area, Wall::kSouth, along), true, random);
  }
}

}  // namespace cpslam::sim
