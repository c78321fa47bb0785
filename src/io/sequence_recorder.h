#pragma once

#include <atomic>
#include <cstddef>
#include <fstream>
#include <string>

#include "cpslam/rgbd_frame.h"
#include "cpslam/settings.h"
#include "util/best_effort_worker.h"

namespace cpslam {

/// Writes frames as a sequence in TUM layout (rgb/, depth/, rgb.txt, depth.txt, settings.yaml), losslessly,
/// from a thread of its own. The lists grow line by line with the files, so that whatever ends the program
/// leaves a sequence that can be read. A frame that cannot be written, as on a full disk, ends the recording
/// with a warning and nothing else. add() and finish() from one thread.
class SequenceRecorder {
 public:
  /// Makes the folder. Throws InputError naming it when it is not empty or cannot be written.
  SequenceRecorder(std::string folder, const Settings& settings, WhenBusy when_busy, LogSink log);

  /// The images (depth: CV_16UC1) are not to be written to any more.
  void add(const RgbdFrame& frame) { worker_.add(frame); }
  /// Writes what is waiting and ends the thread.
  void finish() { worker_.finish(); }

  [[nodiscard]] const std::string& folder() const { return folder_; }
  /// Frames on disk: all of them after finish().
  [[nodiscard]] std::size_t recorded() const { return recorded_; }
  /// Frames left out because too many were waiting.
  [[nodiscard]] std::size_t dropped() const { return worker_.left_out(); }
  /// False when the recording was ended by a frame that could not be written.
  [[nodiscard]] bool complete() const { return !worker_.failed(); }

 private:
  void write(const RgbdFrame& frame);
  void write_picture(const std::string& file, const cv::Mat& picture) const;

  const std::string folder_;
  std::ofstream colour_list_, depth_list_;  // by the worker's thread only
  std::atomic<std::size_t> recorded_ = 0;
  BestEffortWorker<RgbdFrame> worker_;  // last, so that its thread ends first
};

}  // namespace cpslam
