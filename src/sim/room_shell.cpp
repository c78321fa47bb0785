#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/rooms.h"

namespace cpslam::sim {
namespace {

constexpr double kDoorHeight_m = 2.05;
constexpr double kWallTile_m = 3.0;
constexpr double kFloorTile_m = 1.6;
constexpr double kLightCell_m = 0.5;

int cells(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

void add_wall_part(Mesh& mesh, const SE3& place, double begin, double end, double low, double high,
                   int material) {
  if (end - begin < 1e-6) return;
  add_patch(mesh, place,
            {{begin, 0, low},
             {end - begin, 0, 0},
             {0, 0, high - low},
             cells(end - begin, kLightCell_m),
             cells(high - low, kLightCell_m),
             (end - begin) / kWallTile_m,
             (high - low) / kWallTile_m},
            material);
}

// One wall with its openings; skirting along the closed parts, frames around the openings.
void add_wall(Mesh& mesh, const SE3& place, double length, const RoomSpec& spec, Wall wall,
              const Palette& palette) {
  std::vector<Doorway> doorways;
  for (const Doorway& doorway : spec.doorways)
    if (doorway.wall == wall) doorways.push_back(doorway);
  std::sort(doorways.begin(), doorways.end(),
            [](const Doorway& a, const Doorway& b) { return a.along_m < b.along_m; });
  const auto closed_part = [&](double begin, double end) {
    add_wall_part(mesh, place, begin, end, 0.0, spec.height_m, spec.wall);
    add_box(mesh, place * placed({0.5 * (begin + end), -0.006, 0}), {end - begin, 0.012, 0.08},
            palette.white);
  };
  double begin = -0.5 * length;
  for (const Doorway& doorway : doorways) {
    const double left = doorway.along_m - 0.5 * doorway.width_m;
    const double right = doorway.along_m + 0.5 * doorway.width_m;
    closed_part(begin, left);
    add_wall_part(mesh, place, left, right, kDoorHeight_m, spec.height_m, spec.wall);
    for (const double x : {left, right})
      add_box(mesh, place * placed({x, 0.025, 0}), {0.08, 0.1, kDoorHeight_m + 0.04}, palette.white);
    add_box(mesh, place * placed({doorway.along_m, 0.025, kDoorHeight_m}), {doorway.width_m, 0.1, 0.08},
            palette.white);
    begin = right;
  }
  closed_part(begin, 0.5 * length);
}

void add_lamps(Scene& scene, Mesh& mesh, const RoomSpec& spec, const Palette& palette) {
  const Eigen::Vector2d size = spec.area.sizes();
  Lamp lamp;
  lamp.room_id = static_cast<int>(scene.rooms.size());
  constexpr double kSlack_m = 0.1;  // reaches through the doorway's frame
  lamp.room.extend(Eigen::Vector3d(spec.area.min().x() - kSlack_m, spec.area.min().y() - kSlack_m, -kSlack_m)
                       .cast<float>());
  lamp.room.extend(Eigen::Vector3d(spec.area.max().x() + kSlack_m, spec.area.max().y() + kSlack_m,
                                   spec.height_m + kSlack_m)
                       .cast<float>());
  for (const double u : {0.27, 0.73}) {
    for (const double v : {0.27, 0.73}) {
      const Eigen::Vector3d at(spec.area.min().x() + u * size.x(), spec.area.min().y() + v * size.y(),
                               spec.height_m - 0.01);
      add_patch(mesh, placed(at), {{-0.6, 0.15, 0}, {1.2, 0, 0}, {0, -0.3, 0}}, palette.lamp);
      lamp.position = (at - Eigen::Vector3d(0, 0, 0.15)).cast<float>();
      scene.lighting.add(lamp);
    }
  }
}

}  // namespace

SE3 wall_place(const Eigen::AlignedBox2d& area, Wall wall, double along_m) {
  const Eigen::Vector2d middle = area.center();
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  switch (wall) {
    case Wall::kNorth:
      return placed({middle.x() + along_m, area.max().y(), 0}, 0.0);
    case Wall::kEast:
      return placed({area.max().x(), middle.y() - along_m, 0}, -kQuarter);
    case Wall::kSouth:
      return placed({middle.x() - along_m, area.min().y(), 0}, 2.0 * kQuarter);
    case Wall::kWest:
      break;
  }
  return placed({area.min().x(), middle.y() + along_m, 0}, kQuarter);
}

void build_shell(Scene& scene, Furnisher& furnisher, const RoomSpec& spec) {
  const Eigen::Vector2d size = spec.area.sizes();
  const Eigen::Vector2d low = spec.area.min();
  Mesh floor;
  // The floor reaches under the walls, into the doorways.
  constexpr double kUnder_m = 0.06;
  const Eigen::Vector2d wide = size + Eigen::Vector2d::Constant(2 * kUnder_m);
  add_patch(floor, SE3(),
            {{low.x() - kUnder_m, low.y() - kUnder_m, 0},
             {wide.x(), 0, 0},
             {0, wide.y(), 0},
             cells(wide.x(), 0.16),
             cells(wide.y(), 0.16),
             wide.x() / kFloorTile_m,
             wide.y() / kFloorTile_m},
            spec.floor);
  furnisher.add(std::move(floor), false);
  Mesh ceiling;
  add_patch(ceiling, SE3(),
            {{low.x() - kUnder_m, spec.area.max().y() + kUnder_m, spec.height_m},
             {wide.x(), 0, 0},
             {0, -wide.y(), 0},
             cells(wide.x(), kLightCell_m),
             cells(wide.y(), kLightCell_m),
             wide.x() / 1.2,
             wide.y() / 1.2},
            furnisher.palette().ceiling);
  add_lamps(scene, ceiling, spec, furnisher.palette());
  furnisher.add(std::move(ceiling), false);
  for (const Wall wall : {Wall::kNorth, Wall::kEast, Wall::kSouth, Wall::kWest}) {
    const double length = wall == Wall::kNorth || wall == Wall::kSouth ? size.x() : size.y();
    Mesh mesh;
    add_wall(mesh, wall_place(spec.area, wall, 0.0), length, spec, wall, furnisher.palette());
    furnisher.add(std::move(mesh), false);
  }
  Eigen::AlignedBox3f room;
  room.extend(Eigen::Vector3d(low.x(), low.y(), 0).cast<float>());
  room.extend(Eigen::Vector3d(spec.area.max().x(), spec.area.max().y(), spec.height_m).cast<float>());
  scene.rooms.push_back(room);
}

}  // namespace cpslam::sim
