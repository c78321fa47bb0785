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
      worker_([this](const Picture& picture) { write(picture); }, kMaxWaiting, when_busy, std::move(log),
              "no more pictures are drawn") {
  prepare_output_folder("--draw", folder_);
  worker_.start();
}

void PictureWriter::write(const Picture& picture) const {
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", paint(picture.image, picture.view), jpeg, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  const std::string_view bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
  write_file_atomically(folder_ + "/" + stamp_text(picture.view.time_s) + ".jpg", bytes);
}

}  // namespace cpslam::program
