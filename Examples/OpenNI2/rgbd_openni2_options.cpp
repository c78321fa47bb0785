#include "rgbd_openni2_options.h"

#include <CLI/CLI.hpp>

#include "common/option_checks.h"
#include "common/run_program.h"
#include "common/size_option.h"
#include "openni/library.h"

namespace cpslam::program {
namespace {

constexpr double kLongestS = 1e6;

std::string list_text() {
  std::string text;
  for (const CameraInfo& camera : list_cameras())
    text += camera.uri + "  " + camera.vendor + " " + camera.name + "\n";
  if (text.empty()) return "no camera that OpenNI2 knows is plugged in";
  text.pop_back();
  return text;
}

void add_exposure_option(CLI::App& app, const std::string& group, CameraOptions& camera) {
  const auto take = [&camera](const std::string& text) {
    if (text != "on" && text != "off")
      throw CLI::ValidationError("--auto-exposure", "'" + text + "' is none of on|off");
    camera.auto_exposure = text == "on";
  };
  app.add_option_function<std::string>("--auto-exposure", take,
                                       "Whether the camera sets its exposure; default as it comes")
      ->type_name("on|off")
      ->group(group);
}

void add_camera_options(CLI::App& app, RgbdOpenni2Options& options) {
  const std::string group = "What to run on";
  add_vocabulary_argument(app, options.slam);
  app.add_option(
      "SETTINGS", options.slam.settings,
      "Camera and feature settings (ORB-SLAM2's format); left out: a pinhole made of the camera's\n"
      "field of view, which a calibration beats");
  app.add_option("--device", options.camera.device,
                 "Camera by its URI or a part of its name, or an .oni file; default the first camera")
      ->type_name("DEVICE|FILE")
      ->group(group);
  app.add_flag_callback(
         "--list", [] { throw CLI::CallForVersion(list_text(), 0); }, "List the cameras and end")
      ->group(group);
  add_size_option(app, group, options.camera.width, options.camera.height);
  app.add_option("--fps", options.camera.fps, "Of the camera, images a second")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->group(group);
  add_exposure_option(app, group, options.camera);
  app.add_option("--duration", options.duration_s, "Ends after so many seconds; default at Ctrl-C")
      ->check(CLI::Range(0.0, kLongestS))
      ->type_name("SECONDS")
      ->group(group);
  app.add_option("--max-frames", options.max_frames, "Ends after so many frames")
      ->check(check_positive_count)
      ->group(group);
}

void add_trouble_options(CLI::App& app, RgbdOpenni2Options& options) {
  const std::string group = "When the camera is gone";
  app.add_option("--stall-seconds", options.stall_s, "No frame for so long: the camera counts as gone")
      ->check(CLI::Range(0.1, kLongestS))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(group);
  app.add_option("--reconnect-seconds", options.reconnect_s,
                 "What was tracked is saved, and the camera waited for so long; 0: not at all")
      ->check(CLI::Range(0.0, kLongestS))
      ->type_name("SECONDS")
      ->capture_default_str()
      ->group(group);
}

/// A camera never waits; a file does unless it is told not to.
void check_source(RgbdOpenni2Options& options) {
  const bool file = is_recording(options.camera.device);
  if (!file && options.slam.sequential)
    throw CLI::ValidationError("--sequential", "goes with a file alone: a camera does not wait");
  if (!file) options.slam.realtime = true;
  options.camera.at_recorded_speed = file && options.slam.realtime;
  check(options.slam);
}

}  // namespace

RgbdOpenni2Options parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  RgbdOpenni2Options options;
  CLI::App app{
      "Tracks an RGB-D camera that OpenNI2 knows (Asus Xtion, PrimeSense, Orbbec, ...), or a file recorded "
      "from\n"
      "one, and writes CameraTrajectory.txt, KeyFrameTrajectory.txt and stats.json. Ctrl-C ends the run.\n\n"
      "Examples:\n"
      "  rgbd_openni2 --list\n"
      "  rgbd_openni2 - my_camera.yaml --record session --output results\n"
      "  rgbd_openni2 - --device recording.oni --sequential --output results"};
  add_camera_options(app, options);
  add_trouble_options(app, options);
  add_slam_options(app, options.slam,
                   "Play a file at its recorded speed and drop frames when late; a camera always does");
  app.add_option("--record", options.record,
                 "Write what is tracked as a sequence for rgbd_tum, into a folder that is empty or not there")
      ->type_name("DIR")
      ->group("Results and messages");
  app.callback([&options] { check_source(options); });
  app.set_version_flag("--version", "rgbd_openni2 (CP-SLAM) " CPSLAM_VERSION);
  exit_code = parse(app, "rgbd_openni2", argc, argv);
  return options;
}

}  // namespace cpslam::program
