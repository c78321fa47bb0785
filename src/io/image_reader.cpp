#include "io/image_reader.h"

#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <utility>

#include "cpslam/error.h"
#include "io/image_integrity.h"
#include "io/input_file.h"
#include "util/bounded_queue.h"
#include "util/worker.h"

namespace cpslam {
namespace {

constexpr std::size_t kLargestFile = 1U << 30U;  // bytes; cv::Mat counts in int

/// Throws InputError for a file that is not a whole image.
cv::Mat decode(const std::string& path, int flags) {
  std::string bytes = read_input_file(path);
  if (const std::string error = image_integrity_error(bytes); !error.empty()) {
    throw InputError("'" + path + "' " + error);
  }
  if (bytes.size() > kLargestFile) throw InputError("'" + path + "' is too large for an image");
  cv::Mat image;
  try {
    image = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data()), flags);
  } catch (const cv::Exception&) {
    // OpenCV's texts run over several lines; the empty image below says the same in one.
    image.release();
  }
  if (image.empty()) throw InputError("'" + path + "' is damaged: it cannot be decoded");
  return image;
}

std::string describe(const cv::Mat& image) {
  return std::to_string(image.elemSize1() * 8) + (image.depth() >= CV_32F ? "-bit float" : "-bit") +
         " with " + std::to_string(image.channels()) + (image.channels() == 1 ? " channel" : " channels");
}

cv::Mat read_depth(const std::string& path) {
  cv::Mat depth = decode(path, cv::IMREAD_UNCHANGED);
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw InputError("depth image '" + path + "' is " + describe(depth) +
                     ": 16-bit or 32-bit float with 1 channel is needed");
  }
  return depth;
}

std::string size_text(const cv::Mat& image) {
  return std::to_string(image.cols) + "x" + std::to_string(image.rows);
}

}  // namespace

cv::Mat read_colour_image(const std::string& path) {
  // Turning the image as its EXIF tag asks would part it from its depth.
  cv::Mat colour = decode(path, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  if (colour.type() != CV_8UC3 && colour.type() != CV_8UC1) {
    throw InputError("colour image '" + path + "' is " + describe(colour) +
                     ": 8-bit with 1 or 3 channels is needed");
  }
  return colour;
}

RgbdImages read_rgbd(const RgbdEntry& entry) {
  RgbdImages images;
  images.time_s = entry.time_s;
  images.depth_time_s = entry.depth_time_s;
  try {
    cv::Mat colour = read_colour_image(entry.colour_path);
    cv::Mat depth = read_depth(entry.depth_path);
    if (colour.size() != depth.size()) {
      throw InputError("depth image '" + entry.depth_path + "' is " + size_text(depth) +
                       " px, colour image '" + entry.colour_path + "' " + size_text(colour) +
                       " px: depth must be registered to colour");
    }
    images.colour = std::move(colour);
    images.depth = std::move(depth);
  } catch (const InputError& error) {
    images.error = error.what();
  } catch (const std::exception& error) {
    images.error = "cannot read '" + entry.colour_path + "' and its depth: " + error.what();
  }
  return images;
}

struct ReadAhead::Impl {
  Impl(std::vector<RgbdEntry> entries, std::size_t capacity)
      : decoded(capacity),
        left_to_queue(entries.size()),
        decoder([this](RgbdEntry&& entry, const std::stop_token& stop) { decode_one(entry, stop); },
                entries.size() + 1) {
    if (entries.empty()) decoded.close();
    for (RgbdEntry& entry : entries) decoder.push(std::move(entry));
    decoder.start();
  }

  void decode_one(const RgbdEntry& entry, const std::stop_token& stop) {
    try {
      decoded.push(read_rgbd(entry), stop);
    } catch (...) {
      decoded.close();  // next() then finds the exception in the worker
      throw;
    }
    if (--left_to_queue == 0) decoded.close();
  }

  BoundedQueue<RgbdImages> decoded;
  std::size_t left_to_queue;  // by the decoder's thread only
  Worker<RgbdEntry> decoder;  // last, so that its thread ends first
};

ReadAhead::ReadAhead(std::vector<RgbdEntry> entries, std::size_t capacity)
    : impl_(std::make_unique<Impl>(std::move(entries), capacity)) {}

ReadAhead::~ReadAhead() = default;

bool ReadAhead::next(RgbdImages& images) {
  std::optional<RgbdImages> decoded = impl_->decoded.pop();
  if (!decoded) {
    impl_->decoder.wait_idle();
    return false;
  }
  images = std::move(*decoded);
  return true;
}

}  // namespace cpslam
