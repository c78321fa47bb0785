#include <gtest/gtest.h>

#include <cstring>

#include "cpslam/error.h"
#include "sim/simulation.h"

namespace cpslam::sim {
namespace {

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int y = 0; y < a.rows; ++y)
    if (std::memcmp(a.ptr(y), b.ptr(y), a.elemSize() * static_cast<std::size_t>(a.cols)) != 0) return false;
  return true;
}

bool same_frame(const SimulatedFrame& a, const SimulatedFrame& b) {
  return a.time_s == b.time_s && same_bytes(a.colour_bgr, b.colour_bgr) && same_bytes(a.depth, b.depth) &&
         same_bytes(a.person_mask, b.person_mask) && a.people.size() == b.people.size() &&
         a.world_from_camera.rotation == b.world_from_camera.rotation &&
         a.world_from_camera.translation == b.world_from_camera.translation;
}

SimulationOptions noisy_crowd() {
  SimulationOptions options;
  options.preset = "walking_xyz";
  options.seed = 3;
  options.sensor_noise = true;
  options.exposure_drift = true;
  return options;
}

TEST(SimulationDeterminism, FrameDependsOnOptionsAndIndexOnly) {
  Simulation first(noisy_crowd());
  SimulationOptions one_thread = noisy_crowd();
  one_thread.n_threads = 1;
  Simulation second(one_thread);
  const SimulatedFrame straight = first.render(40);
  static_cast<void>(second.render(7));
  static_cast<void>(second.render(41));
  EXPECT_TRUE(same_frame(straight, second.render(40)));
  EXPECT_TRUE(same_frame(straight, first.render(40)));
}

TEST(SimulationDeterminism, BlurIsReproducible) {
  SimulationOptions options = noisy_crowd();
  options.motion_blur = true;
  Simulation first(options);
  Simulation second(options);
  EXPECT_TRUE(same_frame(first.render(5), second.render(5)));
}

TEST(SimulationDeterminism, SeedChangesRoomPathAndNoise) {
  SimulationOptions other = noisy_crowd();
  other.seed = 4;
  Simulation a(noisy_crowd());
  Simulation b(other);
  EXPECT_FALSE(same_bytes(a.render(0).colour_bgr, b.render(0).colour_bgr));
  EXPECT_NE(a.world_from_camera(0).translation, b.world_from_camera(0).translation);
}

TEST(SimulationDeterminism, NoiseSeedLeavesTheWorldAlone) {
  SimulationOptions other = noisy_crowd();
  other.noise_seed = 99;
  Simulation a(noisy_crowd());
  Simulation b(other);
  const SimulatedFrame first = a.render(10);
  const SimulatedFrame second = b.render(10);
  EXPECT_TRUE(same_bytes(first.person_mask, second.person_mask));
  EXPECT_EQ(first.world_from_camera.translation, second.world_from_camera.translation);
  EXPECT_FALSE(same_bytes(first.depth, second.depth));
  EXPECT_FALSE(same_bytes(first.colour_bgr, second.colour_bgr));
}

TEST(SimulationDeterminism, StartShiftsThePath) {
  SimulationOptions options;
  options.preset = "walking_static";
  Simulation whole(options);
  options.start_s = 0.5;
  Simulation later(options);
  EXPECT_TRUE(same_bytes(whole.render(15).colour_bgr, later.render(0).colour_bgr));
}

TEST(SimulationOptions, BadOptionsAreNamed) {
  SimulationOptions options;
  options.preset = "moon";
  EXPECT_THROW(options.check(), InputError);
  options = {};
  options.n_people = SimulationOptions::kMaxPeople + 1;
  EXPECT_THROW(options.check(), InputError);
  options = {};
  options.n_frames = 0;
  EXPECT_THROW(options.check(), InputError);
  options = {};
  Simulation simulation(options);
  EXPECT_THROW(static_cast<void>(simulation.render(simulation.size())), InputError);
  EXPECT_THROW(static_cast<void>(simulation.render(-1)), InputError);
}

}  // namespace
}  // namespace cpslam::sim
