#include "common/picture_writer.h"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "common/frame_painter.h"
#include "common/output_folder.h"
#include "io/atomic_file.h"
#include "io/text_table.h"

namespace cpslam::program {
namespace {

constexpr std::size_t kMaxWaiting = 8;
constexpr int kJpegQuality = 90;

}  // namespace

PictureWriter::PictureWriter(std::string folder, WhenBusy when_busy, LogSink log)
    : folder_(std::move(folder)),
      when_busy_(when_busy),
      log_(std::move(log)),
      worker_([this](Picture&& picture, const std::stop_token&) { write(picture); }, kMaxWaiting) {
  prepare_output_folder("--draw", folder_);
  worker_.start();
}

void PictureWriter::add(const cv::Mat& image, FrameView view) {
  if (ended_) return;
  Picture picture{image, std::move(view)};
  try {
    if (when_busy_ == WhenBusy::kWait) {
      worker_.push(std::move(picture));
    } else if (!worker_.try_push(picture)) {
      ++left_out_;
    }
  } catch (const std::exception& error) {
    give_up(error.what());
  }
}

void PictureWriter::finish() {
  worker_.stop(OnStop::kDrain);
  if (ended_) return;
  try {
    worker_.rethrow_if_failed();
  } catch (const std::exception& error) {
    give_up(error.what());
  }
}

/// What the worker's handler threw has ended its thread.
void PictureWriter::give_up(const std::string& reason) {
  ended_ = true;
  if (log_) log_(LogLevel::kWarning, reason + "; no more pictures are drawn");
}

void PictureWriter::write(const Picture& picture) const {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", paint(picture.image, picture.view), jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  const std::string_view bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
  write_file_atomically(folder_ + "/" + stamp_text(picture.view.time_s) + ".jpg", bytes);
}

}  // namespace cpslam::program
