#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "common/progress_bar.h"
#include "common/run_program.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "sim/sequence_writer.h"
#include "sim/simulation.h"

namespace cpslam::program {
namespace {

struct SimulateOptions {
  sim::SimulationOptions simulation;
  sim::WriteOptions write;
  std::string directory;
  bool list_presets = false;
  bool quiet = false;
};

SimulateOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  SimulateOptions options;
  sim::SimulationOptions& simulation = options.simulation;
  simulation.preset.clear();
  CLI::App app{
      "Renders an RGB-D sequence in TUM format with exact ground truth: rgb/, depth/, rgb.txt, depth.txt,\n"
      "groundtruth.txt, person_boxes.txt and settings.yaml (for rgbd_tum).\n\n"
      "Example: simulate_tum walking_xyz /tmp/crowd --people 4 --noise"};
  app.add_option("PRESET", simulation.preset, "What to simulate; --list-presets names them");
  app.add_option("OUTPUT_DIR", options.directory, "Folder for the sequence, made when missing");
  app.add_option("--seed", simulation.seed, "Seed of room, path, people and noise")->capture_default_str();
  app.add_option("--noise-seed", simulation.noise_seed, "Seed of the noise alone; default --seed");
  app.add_option("--frames", simulation.n_frames, "Number of frames; default the preset's");
  app.add_option("--start", simulation.start_s, "Seconds into the path at which to begin")
      ->capture_default_str();
  app.add_option("--people", simulation.n_people, "Number of people; default the preset's");
  app.add_flag("--noise", simulation.sensor_noise, "Noise of a structured-light camera, holes included");
  app.add_flag("--blur", simulation.motion_blur, "Motion blur of 20 ms exposure (six times slower)");
  app.add_flag("--exposure", simulation.exposure_drift, "Brightness that wanders by up to 25 %");
  app.add_flag("--masks", options.write.masks, "Also masks/ with the person every pixel belongs to");
  app.add_flag("--jpeg", options.write.jpeg, "Colour as JPEG instead of PNG");
  app.add_flag("--force", options.write.force, "Write into a folder that is not empty");
  app.add_option("--threads", simulation.n_threads, "Rendering threads; the result does not depend on them")
      ->capture_default_str();
  app.add_flag("--list-presets", options.list_presets, "List the presets and end");
  app.add_flag("--quiet", options.quiet, "No progress bar");
  app.set_version_flag("--version", "simulate_tum (CP-SLAM) " CPSLAM_VERSION);
  exit_code = parse(app, "simulate_tum", argc, argv);
  return options;
}

void list_presets() {
  for (const sim::PresetInfo& preset : sim::presets())
    std::printf("%-20s %4d frames, %d people: %s\n", preset.name.c_str(), preset.n_frames, preset.n_people,
                preset.description.c_str());
}

int simulate(SimulateOptions options) {
  if (options.list_presets) {
    list_presets();
    return kExitOk;
  }
  if (options.simulation.preset.empty() || options.directory.empty())
    throw InputError("PRESET and OUTPUT_DIR are required; see --help and --list-presets");
  sim::Simulation simulation(options.simulation);
  install_stop_signal();
  ProgressBar bar("rendering", static_cast<std::size_t>(simulation.size()), !options.quiet);
  options.write.on_progress = [&bar](int done, int) {
    bar.update(static_cast<std::size_t>(done));
    return !stop_requested();
  };
  sim::write_sequence(simulation, options.directory, options.write);
  bar.finish();
  return kExitOk;
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  return run_program("simulate_tum", [&] {
    std::optional<int> exit_code;
    SimulateOptions options = parse_command_line(argc, argv, exit_code);
    return exit_code ? *exit_code : simulate(std::move(options));
  });
}
