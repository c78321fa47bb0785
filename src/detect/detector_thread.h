#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "cpslam/person_detector.h"
#include "cpslam/settings.h"
#include "detect/detections.h"
#include "util/log.h"
#include "util/stage_timer.h"

namespace cpslam {

struct DetectorThreadOptions {
  BoxesPolicy policy = BoxesPolicy::kWait;
  bool sequential = false;  ///< no thread: detect in the caller's, so that runs repeat to the bit
  double pretend_rate_hz =
      0.0;  ///< kLatest: detections begin at most this often, in frame stamps; 0: no limit
  double pretend_delay_s = 0.0;  ///< kLatest: and arrive this much later than their frame
  double timeout_s = 10.0;       ///< wall time after which a detection is given up
};

/// Runs a PersonDetector beside the caller, so that ORB extraction and detection of the same frame overlap: a
/// frame's image is offered before its features are extracted, and the boxes are collected after.
/// The members are called from one thread.
class DetectorThread {
 public:
  DetectorThread(std::unique_ptr<PersonDetector> detector, const DetectorThreadOptions& options,
                 StageTimer& timer, Log log);
  /// Joins the thread: waits for a detection under way.
  ~DetectorThread();

  /// Hands over a frame's colour image (shared, not copied: it must not be written to any more). kWait takes
  /// every frame; kLatest replaces an image that still waits by this newer one.
  void offer(std::uint64_t frame, double time_s, const cv::Mat& colour);

  /// What has arrived since the last call, oldest first. kWait: waits for the detections of this very frame;
  /// comes back without them when the detector threw or takes longer than the timeout. kLatest: never waits.
  [[nodiscard]] std::vector<Detections> collect(std::uint64_t frame, double time_s);

  /// Images the detector has finished or failed on, and of them the failures.
  [[nodiscard]] std::size_t n_detections() const;
  [[nodiscard]] std::size_t n_failures() const;
  /// A detection was given up and has not come back since: the destructor would wait for it.
  [[nodiscard]] bool is_stuck() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
