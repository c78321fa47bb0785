#include "programs/office_sequence.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "sim/sequence_writer.h"

namespace cpslam {
namespace {

bool names_detector(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    return argument == "--detector" || argument == "--boxes" || argument == "--model";
  });
}

}  // namespace

OfficeSequence::OfficeSequence(const std::string& preset, double start_s) {
  sim::SimulationOptions options;
  options.preset = preset;
  options.start_s = start_s;
  options.n_frames = static_cast<int>(kFrames);
  options.camera.width = kWidth;
  options.camera.height = kHeight;
  for (double* const length_px :
       {&options.camera.fx, &options.camera.fy, &options.camera.cx, &options.camera.cy, &options.camera.bf}) {
    *length_px /= 2.0;
  }
  sim::Simulation simulation(options);
  sim::write_sequence(simulation, path(), {});
  for (const RgbdEntry& entry : associate_sequence(path())) {
    times_s_.push_back(entry.time_s);
    colour_.push_back(std::filesystem::relative(entry.colour_path, path()).string());
    depth_.push_back(std::filesystem::relative(entry.depth_path, path()).string());
  }
}

std::string OfficeSequence::associations(
    const std::vector<std::pair<std::string, std::string>>& pairs) const {
  std::string text;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    char stamp[32];
    std::snprintf(stamp, sizeof stamp, "%.6f", 1000.0 + static_cast<double>(i) / 30.0);
    text.append(stamp).append(" ").append(pairs[i].first).append(" ");
    text.append(stamp).append(" ").append(pairs[i].second).append("\n");
  }
  return folder_.write("associations.txt", text);
}

std::vector<std::pair<std::string, std::string>> OfficeSequence::pairs(bool backward) const {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const std::size_t frame = backward ? kFrames - 1 - i : i;
    all.emplace_back(colour_[frame], depth_[frame]);
  }
  return all;
}

void OfficeSequence::change_setting(const std::string& key, const std::string& value) const {
  std::string text = TemporaryFolder::content(settings());
  const std::size_t at = text.find(key + ": ");
  if (at == std::string::npos) throw std::invalid_argument(key);
  text.replace(at, text.find('\n', at) - at, key + ": " + value);
  folder_.write("office/settings.yaml", text);
}

ProgramResult OfficeSequence::track(const std::vector<std::string>& arguments,
                                    const SignalAt& signal_at) const {
  std::vector<std::string> all{"-", settings(), path()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (!names_detector(arguments)) all.insert(all.end(), {"--detector", "none"});
  all.insert(all.end(), {"--output", output()});
  return run_rgbd_tum(all, signal_at);
}

nlohmann::json OfficeSequence::stats() const {
  return nlohmann::json::parse(TemporaryFolder::content(result("stats.json")));
}

Trajectory OfficeSequence::trajectory() const {
  return read_trajectory(result("CameraTrajectory.txt"));
}

}  // namespace cpslam
