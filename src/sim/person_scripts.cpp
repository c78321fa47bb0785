#include "sim/person_scripts.h"

#include <cmath>
#include <numbers>

#include "sim/gait.h"
#include "sim/rooms.h"

namespace cpslam::sim {
namespace {

constexpr double kPi = std::numbers::pi;
using Points = std::vector<Eigen::Vector2d>;
using Hands = std::array<std::optional<Eigen::Vector3d>, 2>;

// There along a line and back beside it.
SmoothCurve to_and_fro(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double apart_m) {
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d aside = 0.5 * apart_m * Eigen::Vector2d(-along.y(), along.x());
  const Eigen::Vector2d middle = 0.5 * (from + to);
  return SmoothCurve({from - aside, middle - aside, to - aside, to + 0.7 * apart_m * along, to + aside,
                      middle + aside, from + aside, from - 0.7 * apart_m * along},
                     true);
}

// Round the office's desks, outset metres from the usual lane.
SmoothCurve round_the_desks(double front_x, double outset_m, bool reversed) {
  const double west = front_x - 0.4 * outset_m, east = 5.3 + outset_m;
  const double south = 0.74 - 0.3 * outset_m, north = 4.86 + 0.3 * outset_m;
  Points points{{west, 1.3}, {west, 4.3}, {west + 0.5, north}, {east - 0.5, north},
                {east, 4.3}, {east, 1.3}, {east - 0.5, south}, {west + 0.5, south}};
  if (reversed) points = Points(points.rbegin(), points.rend());
  return SmoothCurve(points, true);
}

std::unique_ptr<PersonScript> front_walker(double front_x, double speed, bool stops, double start_s) {
  SmoothCurve curve = to_and_fro({front_x, 0.9}, {front_x, 4.7}, 0.25);
  std::vector<Stop> list;
  if (stops) {
    Stop talk;
    talk.at_m = curve.closest({front_x + 0.125, OfficePlan::kMiddle_y + 0.3});
    talk.duration_s = 3.5;
    talk.facing_rad = 0.8 * kPi;
    talk.gesture = true;
    list.push_back(talk);
  }
  return std::make_unique<WalkerScript>(std::move(curve), speed, std::move(list), start_s);
}

// Behind the desks; comes up between the chairs and leans on the table.
std::unique_ptr<PersonScript> back_walker(double speed, double start_s) {
  SmoothCurve curve({{5.6, 0.9},
                     {5.6, 2.0},
                     {4.78, 2.8},
                     {5.6, 3.6},
                     {5.6, 4.7},
                     {5.3, 4.9},
                     {5.12, 4.4},
                     {5.12, 2.8},
                     {5.12, 1.2},
                     {5.3, 0.7}},
                    true);
  Stop lean;
  lean.at_m = curve.closest({4.78, 2.8});
  lean.duration_s = 4.0;
  lean.facing_rad = kPi;
  constexpr double kDeskEdge_x = OfficePlan::kDeskBack_x - 0.06, kPalm_z = OfficePlan::kDeskHeight_m + 0.03;
  lean.hands_on = {Eigen::Vector3d(kDeskEdge_x, 2.58, kPalm_z), Eigen::Vector3d(kDeskEdge_x, 3.02, kPalm_z)};
  return std::make_unique<WalkerScript>(std::move(curve), speed, std::vector<Stop>{lean}, start_s);
}

// Between the east wall, where he leans, and the shelves, where he takes hold of a book.
std::unique_ptr<PersonScript> wall_walker(double speed, double start_s) {
  SmoothCurve curve(
      {{6.26, 2.7}, {6.0, 3.2}, {5.95, 4.0}, {5.8, 4.4}, {5.62, 4.0}, {5.75, 3.0}, {5.95, 2.45}}, true);
  Stop wall;
  wall.at_m = curve.closest({6.26, 2.7});
  wall.duration_s = 5.0;
  wall.facing_rad = kPi;
  Stop shelf;
  shelf.at_m = curve.closest({5.95, 4.0});
  shelf.duration_s = 4.0;
  shelf.facing_rad = 0.0;
  shelf.hands_on[1] = Eigen::Vector3d(6.27, 3.85, 1.25);
  return std::make_unique<WalkerScript>(std::move(curve), speed, std::vector<Stop>{wall, shelf}, start_s);
}

std::unique_ptr<PersonScript> office_walker(const PresetInfo& preset, int id, Random& random) {
  // The halfsphere brings the camera close to the desks: people pass behind it.
  const double front_x = preset.path == PathKind::kHalfsphere ? 1.1 : 2.05;
  const double start_s = random.uniform(0.0, 12.0);
  const double speed = random.uniform(0.85, 1.2);
  switch (id) {
    case 0:
      return std::make_unique<WalkerScript>(round_the_desks(front_x, 0.0, false), speed, std::vector<Stop>{},
                                            start_s);
    case 1:
      return front_walker(front_x, speed, true, start_s);
    case 2:
      return back_walker(speed, start_s);
    case 3:
      return std::make_unique<WalkerScript>(round_the_desks(front_x, 0.3, true), speed, std::vector<Stop>{},
                                            start_s);
    case 4:
      return wall_walker(speed, start_s);
    case 5:
      return front_walker(front_x - 0.05, speed + 0.15, false, start_s);
    case 6:
      return std::make_unique<WalkerScript>(round_the_desks(front_x, 0.45, false), speed, std::vector<Stop>{},
                                            start_s);
    default:
      return back_walker(speed, start_s + 4.0);
  }
}

std::unique_ptr<PersonScript> office_sitter(int id, Random& random) {
  constexpr double z = OfficePlan::kDeskHeight_m + 0.035;
  const auto both = [](const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
    return Hands{left, right};
  };
  using Place = StationaryScript::Place;
  const std::array<Place, 8> places{
      Place{{3.2, 0.72}, 0.5 * kPi, true, both({3.05, 1.26, z}, {3.35, 1.26, z})},
      Place{{3.8, 4.88}, -0.5 * kPi, true, both({3.95, 4.34, z}, {3.65, 4.34, z})},
      Place{{4.66, 2.0}, kPi, true, both({4.2, 1.88, z + 0.02}, {4.2, 2.12, z + 0.02})},
      Place{{4.66, 3.6}, kPi, true, both({4.2, 3.48, z + 0.02}, {4.2, 3.72, z + 0.02})},
      Place{{6.36, 2.7}, kPi, false, Hands{}},
      Place{{4.78, 2.8}, kPi, false, both({4.26, 2.58, z}, {4.26, 3.02, z})},
      Place{{5.95, 4.0}, 0.0, false, Hands{std::nullopt, Eigen::Vector3d(6.27, 3.85, 1.25)}},
      Place{{5.8, 1.2}, 0.9 * kPi, false, Hands{}}};
  return std::make_unique<StationaryScript>(places.at(static_cast<std::size_t>(id)), random);
}

// In rooms of the ring, beside the camera's way.
std::unique_ptr<PersonScript> ring_walker(int id, Random& random) {
  constexpr double kX = RingPlan::kCellX_m, kY = RingPlan::kCellY_m;
  struct Line {
    Eigen::Vector2d from, to;
  };
  const std::array<Line, 8> lines{Line{{1.25 * kX, 0.66 * kY}, {1.75 * kX, 0.66 * kY}},
                                  Line{{2.7 * kX, 0.34 * kY}, {2.7 * kX, 0.66 * kY}},
                                  Line{{1.25 * kX, 1.34 * kY}, {1.75 * kX, 1.34 * kY}},
                                  Line{{2.7 * kX, 1.34 * kY}, {2.7 * kX, 1.66 * kY}},
                                  Line{{0.3 * kX, 1.34 * kY}, {0.3 * kX, 1.66 * kY}},
                                  Line{{0.3 * kX, 0.34 * kY}, {0.3 * kX, 0.66 * kY}},
                                  Line{{1.7 * kX, 0.69 * kY}, {1.3 * kX, 0.69 * kY}},
                                  Line{{1.7 * kX, 1.31 * kY}, {1.3 * kX, 1.31 * kY}}};
  const Line& line = lines.at(static_cast<std::size_t>(id));
  const double speed = random.uniform(0.8, 1.1);
  return std::make_unique<WalkerScript>(to_and_fro(line.from, line.to, 0.35), speed, std::vector<Stop>{},
                                        random.uniform(0.0, 10.0));
}

}  // namespace

std::unique_ptr<PersonScript> make_person_script(const PresetInfo& preset, int id, Random& random) {
  if (preset.place == PlaceKind::kRing) return ring_walker(id, random);
  if (preset.place == PlaceKind::kTwinRoom) {
    const double y = id % 2 == 0 ? 1.3 : 3.7;
    return std::make_unique<WalkerScript>(to_and_fro({2.8, y}, {5.2, y}, 0.35), random.uniform(0.8, 1.1),
                                          std::vector<Stop>{}, random.uniform(0.0, 10.0));
  }
  if (preset.people == PeopleKind::kSitting) return office_sitter(id, random);
  return office_walker(preset, id, random);
}

}  // namespace cpslam::sim
