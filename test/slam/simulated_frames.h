#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/system.h"
#include "sim/simulation.h"
#include "support/half_size.h"

namespace cpslam::test {

/// The first n frames of a walk through the simulated office, at a quarter of the usual image.
struct SimulatedFrames {
  /// noise_seed: of the sensor's noise; empty: none.
  explicit SimulatedFrames(int n, const std::string& preset = "office_xyz",
                           std::optional<std::uint64_t> noise_seed = {}) {
    sim::SimulationOptions options;
    options.preset = preset;
    options.sensor_noise = noise_seed.has_value();
    options.noise_seed = noise_seed;
    options.n_frames = n;
    options.start_s = 2.0;
    halve(options.camera);
    sim::Simulation simulation(options);
    settings = simulation.settings();
    settings.orb.n_features = 500;
    truth = simulation.ground_truth();
    for (int i = 0; i < n; ++i) frames.push_back(simulation.render(i));
  }

  [[nodiscard]] Settings with_mode(bool sequential) const {
    Settings mode = settings;
    mode.sequential = sequential;
    return mode;
  }
  TrackResult track(System& system, std::size_t i) const {
    return system.track(frames[i].colour_bgr, frames[i].depth, frames[i].time_s);
  }

  Settings settings;
  Trajectory truth;
  std::vector<sim::SimulatedFrame> frames;
};

}  // namespace cpslam::test
