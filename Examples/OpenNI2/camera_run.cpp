#include "camera_run.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "common/run_program.h"
#include "cpslam/error.h"
#include "io/text_table.h"

namespace cpslam::program {
namespace {

using Seconds = std::chrono::duration<double>;

/// Not every driver tells that its camera is back: it is tried so often.
constexpr Seconds kRetry{1.0};

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", seconds);
  return text;
}

bool same_camera(const CameraSettings& a, const CameraSettings& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.depth_map_factor == b.depth_map_factor;
}

}  // namespace

CameraRun::CameraRun(const RgbdOpenni2Options& options, SlamSession& session, SequenceRecorder* recorder,
                     RunControl& control, ProgressBar& bar, RunReport& report)
    : options_(options),
      session_(session),
      recorder_(recorder),
      control_(control),
      bar_(bar),
      report_(report),
      live_(report.live.value()),
      is_file_(is_recording(options.camera.device)),
      clock_(options.slam.realtime, 1.0 / report.settings.camera.fps),
      unusable_("frame", bar) {}

int CameraRun::run(std::unique_ptr<RgbdCamera> camera) {
  const std::stop_token stop = control_.token();
  camera_ = std::move(camera);
  device_settings_ = camera_->settings();
  int exit_code = kExitOk;
  try {
    camera_->start();
    CameraFrame frame;
    while (!at_end()) {
      const CameraEvent event = camera_->next(frame, Seconds(options_.stall_s), stop);
      if (event == CameraEvent::kFrame) {
        take(frame);
      } else if (event == CameraEvent::kEnd || event == CameraEvent::kStopped) {
        break;
      } else if (!survive(event, stop)) {
        if (!stop.stop_requested()) exit_code = kExitFailure;
        break;
      }
    }
  } catch (const std::exception& error) {
    bar_.print_line(std::string("error: ") + error.what() + "; saving what was tracked");
    exit_code = kExitFailure;
  }
  add_counts();
  camera_.reset();
  report_.interrupted = stop.stop_requested();
  report_.frames_in_sequence = n_frames_ + report_.dropped;
  report_.unreadable = unusable_.count();
  return report_.unreadable > 0 ? kExitFailure : exit_code;
}

bool CameraRun::at_end() const {
  return (options_.max_frames && n_frames_ >= *options_.max_frames) ||
         (options_.duration_s && report_.sequence_s >= *options_.duration_s);
}

void CameraRun::take(const CameraFrame& frame) {
  if (gone_since_) tell_back();
  const DeviceClock::Times times = clock_.read(frame);
  if (times.jump_s) tell_jump(*times.jump_s);
  if (!first_time_s_) first_time_s_ = times.time_s;
  report_.sequence_s = times.time_s - *first_time_s_;
  RgbdFrame rgbd;
  rgbd.colour = frame.colour.image;
  rgbd.depth = frame.depth.image;
  rgbd.time_s = times.time_s;
  rgbd.depth_time_s = times.depth_time_s;
  if (recorder_ != nullptr) recorder_->add(rgbd);
  ++n_frames_;
  session_.fulfil(control_.take_wishes());
  try {
    track(rgbd, frame);
  } catch (const InputError& error) {
    unusable_.add(stamp_text(rgbd.time_s), error.what());
  }
}

void CameraRun::track(const RgbdFrame& frame, const CameraFrame& taken) {
  const TrackResult result = session_.track(frame);
  if (!is_file_) {
    const auto now = std::chrono::steady_clock::now();
    live_.latency.add(latency_.add(frame.time_s, taken.colour.arrived, now));
  }
  bar_.update(n_frames_, is_tracked(result.state) ? "" : "no pose");
}

void CameraRun::tell_jump(double jump_s) {
  constexpr std::size_t kMaxTold = 5;
  if (++live_.clock_jumps > kMaxTold) return;
  bar_.print_line("warning: the camera's clock jumped by " + seconds_text(jump_s) +
                  (live_.clock_jumps == kMaxTold ? "; further jumps are only counted" : ""));
}

void CameraRun::tell_back() {
  ++live_.reconnects;
  bar_.print_line("the camera is back after " + seconds_text(gone_for().count()));
  gone_since_.reset();
}

void CameraRun::tell_gone(CameraEvent event) {
  ++live_.interruptions;
  const std::string what = event == CameraEvent::kUnplugged
                               ? " is unplugged"
                               : " has delivered nothing for " + seconds_text(options_.stall_s);
  bar_.print_line("warning: " + camera_->name() + what + "; saving what was tracked");
  gone_since_ = std::chrono::steady_clock::now();
}

Seconds CameraRun::gone_for() const {
  return std::chrono::steady_clock::now() - gone_since_.value();
}

bool CameraRun::survive(CameraEvent event, const std::stop_token& stop) {
  if (!gone_since_) {
    tell_gone(event);
    session_.save_so_far();
  }
  add_counts();
  camera_.reset();
  return !is_file_ && reopen(stop);
}

bool CameraRun::reopen(const std::stop_token& stop) {
  const Seconds patience(options_.reconnect_s);
  std::string why_not = "it delivers nothing";
  while (!stop.stop_requested() && gone_for() < patience) {
    if (try_open(why_not)) return true;
    watch_.wait_for_camera(std::min<Seconds>(kRetry, patience - gone_for()), stop);
  }
  if (!stop.stop_requested())
    bar_.print_line("error: the camera has not come back within " + seconds_text(options_.reconnect_s) +
                    ": " + why_not);
  return false;
}

bool CameraRun::try_open(std::string& why_not) {
  try {
    auto camera = std::make_unique<RgbdCamera>(options_.camera, Log());
    if (!same_camera(camera->settings(), device_settings_)) {
      why_not = camera->name() + " is another kind of camera";
      return false;
    }
    camera->start();
    camera_ = std::move(camera);
    clock_.restart();
    return true;
  } catch (const Error& error) {
    why_not = error.what();
    return false;
  }
}

void CameraRun::add_counts() {
  if (!camera_) return;
  const CameraCounts counts = camera_->counts();
  report_.dropped += counts.dropped;
  live_.missed += counts.missed;
  live_.unpaired += counts.unpaired;
}

}  // namespace cpslam::program
