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
  /// kLatest: detections begin this often (0: at every frame) and their boxes arrive this much later, both
  /// counted in frame stamps. When one of them is set the thread never runs ahead or behind of that schedule.
  double pretend_rate_hz = 0.0;
  double pretend_delay_s = 0.0;
  double timeout_s = 10.0;  ///< wall time after which a detection is given up; without a thread: never
};

/// Runs a PersonDetector beside the caller, so that ORB extraction and detection of the same frame overlap: a
/// frame's image is offered before its features are extracted, and the boxes are collected after.
///
/// A detection that throws is reported and leaves no boxes. One that takes longer than the timeout is
/// reported and given up; until it comes back nobody waits and no images pile up behind it, and its boxes are
/// handed out late. The members are called from one thread.
class DetectorThread {
 public:
  DetectorThread(std::unique_ptr<PersonDetector> detector, const DetectorThreadOptions& options,
                 StageTimer& timer, const Log& log);
  /// Joins the thread: waits for a detection under way however long it takes (see finish()).
  ~DetectorThread();

  /// Hands over a frame's colour image (shared, not copied: it must not be written to any more). kWait takes
  /// every frame; kLatest those of its pretended schedule or, without one, replaces an image that still waits
  /// by this newer one. Stamps grow from frame to frame.
  void offer(std::uint64_t frame, double time_s, const cv::Mat& colour);

  /// What has arrived since the last call, oldest first. kWait waits for the detections of the frames offered
  /// so far, a pretended schedule for those that are due at time_s; both come back without the boxes of a
  /// detector that threw or took longer than the timeout. kLatest never waits otherwise.
  [[nodiscard]] std::vector<Detections> collect(double time_s);

  /// Takes no more images, drops those that wait, and waits for the detection under way at most to its
  /// timeout. Afterwards the destructor either returns at once or is_stuck(). Idempotent.
  void finish();

  /// Images the detector has finished or failed on, and of them the failures.
  [[nodiscard]] std::size_t n_detections() const;
  [[nodiscard]] std::size_t n_failures() const;
  /// A detection was given up and has not come back since: the destructor would wait for it.
  [[nodiscard]] bool is_stuck() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
