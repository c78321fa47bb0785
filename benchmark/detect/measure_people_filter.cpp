// measure_people_filter: the people filter against the simulator's exact masks, as a Markdown table.
// docs/method.md has its numbers.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "detect/truth.h"

namespace {

void print_row(const std::string& name, const cpslam::FilterTruth& truth) {
  std::printf("| %s | %.3f (%zu) | %.3f (%zu) | %.3f | %.4f | %.3f |\n", name.c_str(), truth.removed_share(),
              truth.on_people, truth.kept_share(), truth.in_boxes, truth.rim_removed_share(),
              truth.elsewhere_kept_share(), truth.mask_iou());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  cpslam::TruthOptions options;
  options.n_people = 5;
  options.box_jitter = 0.1;
  options.box_missing = 0.1;
  std::vector<std::string> presets{"walking_static", "walking_xyz", "walking_rpy", "walking_halfsphere"};
  CLI::App app{
      "Measures the people filter against the simulator's exact masks, before anything is reinstated."};
  app.add_option("--presets", presets, "What to simulate")->capture_default_str();
  app.add_option("--frames", options.n_frames, "Frames of each")->capture_default_str();
  app.add_option("--people", options.n_people, "People in each")->capture_default_str();
  app.add_option("--seed", options.seed, "Of room, people and noise")->capture_default_str();
  app.add_option("--jitter", options.box_jitter, "Of the sides of boxes, in their size")
      ->capture_default_str();
  app.add_option("--missing", options.box_missing, "Share of the boxes that are not found")
      ->capture_default_str();
  app.add_option("--rate", options.detection_rate_hz, "Detections per second; 0: every frame")
      ->capture_default_str();
  app.add_option("--delay", options.detection_delay_s, "Seconds by which boxes are late")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf("| preset | on people removed | in boxes kept | rim removed | elsewhere kept | mask IoU |\n");
  std::printf("|---|---|---|---|---|---|\n");
  cpslam::FilterTruth all;
  for (const std::string& preset : presets) {
    options.preset = preset;
    const cpslam::FilterTruth truth = cpslam::measure_filter(options);
    print_row(preset, truth);
    all += truth;
  }
  print_row("all", all);
  return 0;
}
