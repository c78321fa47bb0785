#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>

#include "cpslam/log.h"
#include "cpslam/rgbd_frame.h"
#include "util/worker.h"

namespace cpslam::program {

/// Writes painted frames (common/frame_painter.h) into a folder, "<stamp>.jpg", from a thread of its own.
class PictureWriter {
 public:
  enum class WhenBusy { kWait, kLeaveOut };

  /// Makes the folder. Throws InputError naming it when pictures cannot be written there.
  PictureWriter(std::string folder, WhenBusy when_busy, LogSink log);

  /// image: not to be written to any more. After a picture that could not be written, which is warned of
  /// once, no more are taken.
  void add(const cv::Mat& image, FrameView view);
  /// Writes what is waiting and ends the thread.
  void finish();
  /// Not written, because too many were waiting.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  struct Picture {
    cv::Mat image;
    FrameView view;
  };
  void write(const Picture& picture) const;
  void give_up(const std::string& reason);

  const std::string folder_;
  const WhenBusy when_busy_;
  const LogSink log_;
  std::size_t left_out_ = 0;
  bool ended_ = false;
  Worker<Picture> worker_;
};

}  // namespace cpslam::program
