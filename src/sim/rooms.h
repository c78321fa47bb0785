#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/furniture.h"

namespace cpslam::sim {

enum class Wall { kNorth, kEast, kSouth, kWest };  ///< +y, +x, -y, -x

/// A passage in a wall, 2.05 m high.
struct Doorway {
  Wall wall = Wall::kNorth;
  double along_m = 0.0;  ///< of its middle, from the wall's middle, to the right of who faces the wall
  double width_m = 1.1;
};

struct RoomSpec {
  Eigen::AlignedBox2d area;  ///< inner faces of the walls, world x and y
  double height_m = 2.7;
  int floor = 0;
  int wall = 0;
  std::vector<Doorway> doorways;
};

/// The place (see Furnisher) at a wall.
[[nodiscard]] SE3 wall_place(const Eigen::AlignedBox2d& area, Wall wall, double along_m);

/// Floor, ceiling with lamps, walls with openings and skirting.
void build_shell(Scene& scene, Furnisher& furnisher, const RoomSpec& spec);

/// Where things are in the office; the paths of camera and people rely on it.
struct OfficePlan {
  static constexpr double kWest = -0.4, kEast = 6.6, kSouth = 0.0, kNorth = 5.6;
  static constexpr double kMiddle_y = 2.8;
  static constexpr double kDeskFront_x = 2.7, kDeskBack_x = 4.32;  ///< of the island of four desks
  static constexpr double kDeskSouth_y = 1.2, kDeskNorth_y = 4.4;
  static constexpr double kDeskHeight_m = 0.74;
};

/// An office: four desks back to back in the middle, shelves, windows, posters. With end_chairs, two more
/// chairs stand at the ends of the desks.
void build_office(Scene& scene, Furnisher& furnisher, bool end_chairs, Random& random);

/// Six rooms in a ring, three by two, joined by doorways.
struct RingPlan {
  static constexpr double kCellX_m = 5.4, kCellY_m = 5.0, kWall_m = 0.12;
  static constexpr double kDoorOffset_m = 0.4;
};
void build_ring(Scene& scene, Furnisher& furnisher, Random& random);

/// A room with two identical desks at opposite walls.
struct TwinPlan {
  static constexpr double kLength_m = 8.0, kDepth_m = 5.0;
};
void build_twin_room(Scene& scene, Furnisher& furnisher, Random& random);

}  // namespace cpslam::sim
