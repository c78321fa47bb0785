#include "rgbd_tum_options.h"

#include <CLI/CLI.hpp>

#include "common/option_checks.h"
#include "common/run_program.h"

namespace cpslam::program {
namespace {

void add_input_options(CLI::App& app, RgbdTumOptions& options) {
  const std::string group = "What to run on";
  add_vocabulary_argument(app, options.slam);
  app.add_option("SETTINGS", options.slam.settings, "Camera and feature settings (ORB-SLAM2's format)")
      ->required();
  app.add_option("SEQUENCE", options.sequence, "Folder with rgb.txt, depth.txt and the images")->required();
  app.add_option(
      "ASSOCIATIONS", options.associations,
      "Colour-depth pairs as associate.py writes them; left out: rgb.txt and depth.txt are paired here");
  app.add_option("--start", options.start, "First pair of the sequence to use, counted from 0")
      ->check(check_count)
      ->capture_default_str()
      ->group(group);
  app.add_option("--max-frames", options.max_frames, "How many pairs to use at most; default all")
      ->check(check_positive_count)
      ->group(group);
}

}  // namespace

RgbdTumOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  RgbdTumOptions options;
  CLI::App app{
      "Tracks an RGB-D sequence in TUM format (TUM RGB-D, Bonn RGB-D Dynamic, simulate_tum) and writes\n"
      "CameraTrajectory.txt, KeyFrameTrajectory.txt and stats.json.\n\n"
      "Examples:\n"
      "  rgbd_tum - Examples/RGB-D/TUM1.yaml ~/rgbd_dataset_freiburg1_desk --output results\n"
      "  rgbd_tum - Examples/RGB-D/Bonn.yaml ~/rgbd_bonn_crowd --boxes boxes.txt --draw pictures\n"
      "  rgbd_tum - Examples/RGB-D/Bonn.yaml ~/rgbd_bonn_crowd --save-cloud room.ply"};
  add_input_options(app, options);
  add_slam_options(app, options.slam,
                   "Pace by the time stamps and drop frames when late, like a live camera");
  app.callback([&options] { check(options.slam); });
  app.set_version_flag("--version", "rgbd_tum (CP-SLAM) " CPSLAM_VERSION);
  exit_code = parse(app, "rgbd_tum", argc, argv);
  return options;
}

}  // namespace cpslam::program
