#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>

#include "cpslam/rgbd_frame.h"
#include "util/best_effort_worker.h"

namespace cpslam::program {

/// Writes painted frames (common/frame_painter.h) into a folder, "<stamp>.jpg", from a thread of its own.
class PictureWriter {
 public:
  /// Makes the folder. Throws InputError naming it when pictures cannot be written there.
  PictureWriter(std::string folder, WhenBusy when_busy, LogSink log);

  /// image: not to be written to any more. After a picture that could not be written, which is warned of
  /// once, no more are taken.
  void add(const cv::Mat& image, FrameView view) { worker_.add({image, std::move(view)}); }
  /// Writes what is waiting and ends the thread.
  void finish() { worker_.finish(); }
  /// Not written, because too many were waiting.
  [[nodiscard]] std::size_t left_out() const { return worker_.left_out(); }

 private:
  struct Picture {
    cv::Mat image;
    FrameView view;
  };
  void write(const Picture& picture) const;

  const std::string folder_;
  BestEffortWorker<Picture> worker_;
};

}  // namespace cpslam::program
