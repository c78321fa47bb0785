#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "sim/simulation.h"

namespace cpslam::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Motion {
  double fastest_mps = 0.0, fastest_radps = 0.0;
  Eigen::AlignedBox3d extent;
  double largest_turn = 0.0;  // from the first frame, rad
};

Motion measure(const Simulation& simulation) {
  Motion motion;
  const SE3 first = simulation.world_from_camera(0);
  for (int i = 0; i < simulation.size(); ++i) {
    const SE3 pose = simulation.world_from_camera(i);
    motion.extent.extend(pose.translation);
    motion.largest_turn =
        std::max(motion.largest_turn, rotation_angle(first.rotation.transpose() * pose.rotation));
    if (i == 0) continue;
    const SE3 before = simulation.world_from_camera(i - 1);
    const double rate = simulation.camera().fps;
    motion.fastest_mps = std::max(motion.fastest_mps, rate * (pose.translation - before.translation).norm());
    motion.fastest_radps =
        std::max(motion.fastest_radps, rate * rotation_angle(before.rotation.transpose() * pose.rotation));
  }
  return motion;
}

Simulation make(const std::string& preset, std::uint64_t seed) {
  SimulationOptions options;
  options.preset = preset;
  options.seed = seed;
  return Simulation(options);
}

void expect_inside(const Simulation& simulation) {
  int blocked = 0;
  for (int i = 0; i < simulation.size(); ++i) {
    const Eigen::Vector3f at = simulation.world_from_camera(i).translation.cast<float>();
    const bool in_a_room =
        std::any_of(simulation.rooms().begin(), simulation.rooms().end(), [&](const auto& room) {
          return room.exteriorDistance(at) < 0.08F;  // half a wall: doorways
        });
    ASSERT_TRUE(in_a_room) << "frame " << i << " at " << at.transpose();
    for (const auto& box : simulation.obstacles()) blocked += box.exteriorDistance(at) < 0.1F ? 1 : 0;
  }
  EXPECT_EQ(blocked, 0) << "frames inside furniture";
}

class Paths : public testing::TestWithParam<std::string> {};

TEST_P(Paths, MoveAsAHandMovesAndStayClearOfWallsAndFurniture) {
  const Simulation simulation = make(GetParam(), 5);
  const Motion motion = measure(simulation);
  EXPECT_LT(motion.fastest_mps, 0.85);
  EXPECT_LT(motion.fastest_radps, 65.0 * kDegree);
  expect_inside(simulation);
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const PresetInfo& preset : presets()) names.push_back(preset.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(AllPresets, Paths, testing::ValuesIn(preset_names()),
                         [](const auto& param_info) { return param_info.param; });

TEST(PathShapes, AreWhatTheirNamesSay) {
  const Motion still = measure(make("office_static", 1));
  EXPECT_LT(still.extent.diagonal().norm(), 0.03);
  EXPECT_GT(still.extent.diagonal().norm(), 0.002);
  const Motion xyz = measure(make("office_xyz", 1));
  EXPECT_GT(xyz.extent.diagonal().x(), 0.7);
  EXPECT_GT(xyz.extent.diagonal().y(), 0.7);
  EXPECT_GT(xyz.extent.diagonal().z(), 0.45);
  EXPECT_LE(xyz.fastest_mps, 0.55);
  const Motion rpy = measure(make("office_rpy", 1));
  EXPECT_GT(rpy.largest_turn, 25.0 * kDegree);
  EXPECT_LT(rpy.extent.diagonal().norm(), 0.2);
  const Motion halfsphere = measure(make("office_halfsphere", 1));
  EXPECT_GT(halfsphere.extent.diagonal().y(), 1.0);
  EXPECT_GT(halfsphere.largest_turn, 35.0 * kDegree);
}

TEST(PathShapes, OtherSeedsStayClearToo) {
  for (const std::uint64_t seed : {0U, 1U, 2U})
    for (const char* preset : {"office_xyz", "office_halfsphere", "office_rounds", "ring"})
      expect_inside(make(preset, seed));
}

TEST(PathShapes, RingVisitsSixRoomsAndComesBack) {
  const Simulation simulation = make("ring", 3);
  ASSERT_EQ(simulation.rooms().size(), 6U);
  ASSERT_GE(simulation.size(), 1500);
  std::set<std::size_t> visited;
  double closest_m = 1e9;
  const Eigen::Vector3d start = simulation.world_from_camera(0).translation;
  for (int i = 0; i < simulation.size(); ++i) {
    const SE3 pose = simulation.world_from_camera(i);
    for (std::size_t k = 0; k < 6; ++k)
      if (simulation.rooms()[k].contains(pose.translation.cast<float>())) visited.insert(k);
    if (i > 1200) closest_m = std::min(closest_m, (pose.translation - start).norm());
  }
  EXPECT_EQ(visited.size(), 6U);
  EXPECT_LT(closest_m, 0.1);
  const Motion motion = measure(simulation);
  EXPECT_GT(motion.fastest_mps, 0.5);
}

}  // namespace
}  // namespace cpslam::sim
