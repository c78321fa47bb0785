#include <chrono>
#include <cstddef>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "common/console_log.h"
#include "common/progress_bar.h"
#include "common/stop_signal.h"
#include "diagnosis/examination.h"
#include "diagnosis/stamps.h"
#include "examine.h"
#include "openni/rgbd_camera.h"
#include "util/format_text.h"
#include "util/worker.h"

namespace cpslam::program {
namespace {

using diagnosis::Finding;
using diagnosis::Findings;
using diagnosis::Level;

constexpr std::chrono::duration<double> kPatience{5.0};
constexpr std::size_t kMaxWaiting = 64;  // frames, some 100 MB

/// What a camera delivers in some seconds. The pictures are looked at in a thread of their own: whoever is
/// slower than the camera would see gaps that are his.
class CameraVisit {
 public:
  CameraVisit(const DoctorOptions& options, RgbdCamera& camera, const CameraSettings& settings)
      : options_(options),
        camera_(camera),
        is_file_(is_recording(*options.camera)),
        examination_(settings),
        looker_([this](RgbdImages&& images, const std::stop_token&) { examination_.add(images); },
                kMaxWaiting) {}

  /// Takes as many frames as are wanted, or as there are.
  void take_frames(ProgressBar& bar, const std::stop_token& stop) {
    looker_.start();
    camera_.start();
    CameraFrame frame;
    while (colour_s_.size() < options_.n_frames) {
      last_event_ = camera_.next(frame, kPatience, stop);
      if (last_event_ != CameraEvent::kFrame) break;
      take(frame);
      bar.update(colour_s_.size());
    }
    looker_.wait_idle();
  }

  [[nodiscard]] Findings findings() const {
    Findings all{delivery()};
    for (const Findings& more : {diagnosis::check_rhythm("colour", colour_s_, camera_.settings().fps),
                                 diagnosis::check_rhythm("depth", depth_s_, std::nullopt),
                                 diagnosis::check_pairs(colour_s_, depth_s_), examination_.findings()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  [[nodiscard]] std::size_t n_examined() const { return examination_.n_frames(); }

 private:
  void take(const CameraFrame& frame) {
    constexpr double kMicro = 1e-6;
    RgbdImages images;
    images.time_s = kMicro * static_cast<double>(frame.colour.time_us);
    images.depth_time_s = kMicro * static_cast<double>(frame.depth.time_us);
    images.colour = frame.colour.image;
    images.depth = frame.depth.image;
    colour_s_.push_back(images.time_s);
    depth_s_.push_back(images.depth_time_s);
    if (is_file_) {
      looker_.push(std::move(images));
    } else if (!looker_.try_push(images)) {
      looker_.rethrow_if_failed();
      ++n_not_looked_at_;
    }
  }

  [[nodiscard]] Finding delivery() const {
    const CameraCounts counts = camera_.counts();
    const auto n_lost = counts.missed + counts.unpaired;
    Finding finding{Level::kOk,
                    "camera",
                    format_text("%zu frames, %zu pictures never came, %zu without depth", colour_s_.size(),
                                counts.missed, counts.unpaired),
                    "",
                    {{"frames", static_cast<double>(colour_s_.size())},
                     {"missed", static_cast<double>(counts.missed)},
                     {"unpaired", static_cast<double>(counts.unpaired)},
                     {"not_looked_at", static_cast<double>(n_not_looked_at_)}}};
    if (last_event_ == CameraEvent::kUnplugged || last_event_ == CameraEvent::kStalled) {
      finding.level = Level::kError;
      finding.what += last_event_ == CameraEvent::kUnplugged
                          ? "; then it was unplugged"
                          : format_text("; then nothing for %.0f s", kPatience.count());
      finding.advice = "another cable, a USB port of its own, no hub; see what the kernel says (dmesg)";
    } else if (20 * n_lost > colour_s_.size()) {
      finding.level = Level::kWarning;
      finding.advice = "a USB port of its own, less load, or a smaller --resolution";
    }
    return finding;
  }

  const DoctorOptions& options_;
  RgbdCamera& camera_;
  const bool is_file_;
  std::vector<double> colour_s_, depth_s_;  // by the camera's clock
  std::size_t n_not_looked_at_ = 0;
  CameraEvent last_event_ = CameraEvent::kFrame;
  diagnosis::Examination examination_;
  Worker<RgbdImages> looker_;  // last, so that its thread ends first
};

/// The settings file's calibration with the device's units of depth, or the device's own word.
CameraSettings camera_settings(const DoctorOptions& options, const RgbdCamera& camera) {
  if (options.settings.empty()) return camera.settings();
  CameraSettings settings = load_settings(options.settings).camera;
  settings.depth_map_factor = camera.settings().depth_map_factor;
  return settings;
}

}  // namespace

DoctorReport examine_camera(const DoctorOptions& options) {
  ProgressBar bar("looking", options.n_frames, !options.quiet);
  CameraOptions camera_options;
  camera_options.device = *options.camera;
  camera_options.width = options.width;
  camera_options.height = options.height;
  RgbdCamera camera(camera_options, Log(console_log(bar, options.quiet)));
  const StopSignal stop;
  CameraVisit visit(options, camera, camera_settings(options, camera));
  visit.take_frames(bar, stop.token());
  bar.finish();
  DoctorReport report;
  report.source = camera.name();
  report.settings = options.settings;
  report.examined = visit.n_examined();
  report.interrupted = stop_requested();
  report.findings = visit.findings();
  return report;
}

}  // namespace cpslam::program
