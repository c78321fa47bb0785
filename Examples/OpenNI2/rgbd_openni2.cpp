// rgbd_openni2: tracks an RGB-D camera through OpenNI2.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "camera_run.h"
#include "common/console_log.h"
#include "common/run_program.h"
#include "common/slam_session.h"
#include "common/stop_signal.h"
#include "common/viewer_session.h"
#include "cpslam/error.h"
#include "openni/rgbd_camera.h"
#include "rgbd_openni2_options.h"

namespace cpslam::program {
namespace {

std::string size_text(const CameraSettings& camera) {
  return std::to_string(camera.width) + "x" + std::to_string(camera.height);
}

/// The settings file's calibration, or the camera's own word where there is none.
Settings make_settings(const RgbdOpenni2Options& options, const RgbdCamera& camera, const Log& log) {
  const CameraSettings& device = camera.settings();
  const std::string& file = options.slam.settings;
  Settings settings;
  if (file.empty()) {
    settings.camera = device;
    if (device.fx <= 0.0 || device.fy <= 0.0)
      throw InputError(camera.name() +
                       " does not tell its field of view: give SETTINGS with its calibration");
  } else {
    settings = load_settings(file);
    if (size_text(settings.camera) != size_text(device))
      throw InputError(file + " is for images of " + size_text(settings.camera) + " px, the camera's have " +
                       size_text(device) + ": give --resolution, or another file");
    if (settings.camera.depth_map_factor != device.depth_map_factor)
      log.info("the camera's depths have " + std::to_string(static_cast<int>(device.depth_map_factor)) +
               " units a metre, whatever DepthMapFactor says");
    settings.camera.depth_map_factor = device.depth_map_factor;
    settings.camera.fps = device.fps;
  }
  apply(options.slam, settings);
  return settings;
}

std::unique_ptr<SequenceRecorder> make_recorder(const RgbdOpenni2Options& options, const Settings& settings,
                                                const LogSink& log) {
  if (options.record.empty()) return nullptr;
  return std::make_unique<SequenceRecorder>(options.record, settings,
                                            settings.realtime ? WhenBusy::kLeaveOut : WhenBusy::kWait, log);
}

int main_program(const RgbdOpenni2Options& options) {
  ProgressBar bar("tracking", 0, !options.slam.quiet);
  const LogSink sink = console_log(bar, options.slam.quiet);
  auto camera = std::make_unique<RgbdCamera>(options.camera, Log(sink));
  RunReport report;
  report.version = CPSLAM_VERSION;
  report.sequence = camera->name();
  report.settings = make_settings(options, *camera, Log(sink));
  report.live.emplace().camera = camera->name();
  if (options.slam.print_settings) std::cout << to_yaml(report.settings) << std::flush;
  note_missing_detector(options.slam);

  SlamSession session(options.slam, report.settings, bar);
  const std::unique_ptr<SequenceRecorder> recorder = make_recorder(options, report.settings, sink);
  const StopSignal stop;
  RunControl control;
  const std::stop_callback on_signal(stop.token(), [&control] { control.quit(); });
  CameraRun run(options, session, recorder.get(), control, bar, report);
  const auto work = [&] {
    const int run_code = run.run(std::move(camera));
    if (recorder) {
      recorder->finish();
      report.live->recording = {recorder->folder(), recorder->recorded(), recorder->dropped(),
                                recorder->complete()};
    }
    return std::max(run_code, session.finish("", report));
  };
  const ViewedRun viewed{.settings = report.settings, .ground_truth = "", .can_pause = false};
  return run_beside_viewer(options.slam, viewed, session, control, work);
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  return run_program("rgbd_openni2", [&] {
    std::optional<int> exit_code;
    const RgbdOpenni2Options options = parse_command_line(argc, argv, exit_code);
    return exit_code ? *exit_code : main_program(options);
  });
}
