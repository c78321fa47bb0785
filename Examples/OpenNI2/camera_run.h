#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <stop_token>

#include "common/left_out.h"
#include "common/progress_bar.h"
#include "common/run_report.h"
#include "common/slam_session.h"
#include "io/sequence_recorder.h"
#include "openni/device_clock.h"
#include "openni/latency_meter.h"
#include "openni/library.h"
#include "openni/rgbd_camera.h"
#include "rgbd_openni2_options.h"
#include "util/run_control.h"

namespace cpslam::program {

/// Feeds a camera's frames to a session until somebody or something ends it. One thread.
class CameraRun {
 public:
  /// recorder: null when nothing is recorded. All must outlive this; the report has its camera.
  CameraRun(const RgbdOpenni2Options& options, SlamSession& session, SequenceRecorder* recorder,
            RunControl& control, ProgressBar& bar, RunReport& report);

  /// Starts the camera; ends when the control quits. Returns an exit code and fills the report's counts. Whatever fails, the session keeps
  /// what it has.
  [[nodiscard]] int run(std::unique_ptr<RgbdCamera> camera);

 private:
  [[nodiscard]] bool at_end() const;
  void take(const CameraFrame& frame);
  void track(const RgbdFrame& frame, const CameraFrame& taken);
  void tell_jump(double jump_s);
  void tell_back();
  void tell_gone(CameraEvent event);
  [[nodiscard]] std::chrono::duration<double> gone_for() const;
  /// The camera is gone: saves what there is and opens it anew. False when that is the end.
  bool survive(CameraEvent event, const std::stop_token& stop);
  bool reopen(const std::stop_token& stop);
  bool try_open(std::string& why_not);
  void add_counts();

  const RgbdOpenni2Options& options_;
  SlamSession& session_;
  SequenceRecorder* const recorder_;
  RunControl& control_;
  ProgressBar& bar_;
  RunReport& report_;
  LiveReport& live_;

  const bool is_file_;
  CameraWatch watch_;
  std::unique_ptr<RgbdCamera> camera_;                               // null while it cannot be opened
  std::optional<std::chrono::steady_clock::time_point> gone_since_;  // until a frame comes
  CameraSettings device_settings_;                                   // what it says about itself
  DeviceClock clock_;
  LatencyMeter latency_;
  LeftOut unusable_;
  std::size_t n_frames_ = 0;
  std::optional<double> first_time_s_;
};

}  // namespace cpslam::program
