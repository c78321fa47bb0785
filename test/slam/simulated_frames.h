#pragma once

#include <vector>

#include "cpslam/system.h"
#include "sim/simulation.h"

namespace cpslam::test {

/// The first n frames of a walk through the simulated office, at a quarter of the usual image.
struct SimulatedFrames {
  explicit SimulatedFrames(int n, const std::string& preset = "office_xyz") {
    sim::SimulationOptions options;
    options.preset = preset;
    options.n_frames = n;
    options.start_s = 2.0;
    CameraSettings& camera = options.camera;
    camera.width /= 2;
    camera.height /= 2;
    camera.fx /= 2.0;
    camera.fy /= 2.0;
    camera.cx = (camera.cx - 0.5) / 2.0;
    camera.cy = (camera.cy - 0.5) / 2.0;
    camera.bf /= 2.0;
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
