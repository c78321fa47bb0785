#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "io/tum_sequence.h"

namespace cpslam {

/// A decoded pair. Either both images are valid or error says in one line which file is bad and how.
struct RgbdImages {
  double time_s = 0.0;  ///< of the colour image
  double depth_time_s = 0.0;
  cv::Mat colour;  ///< CV_8UC3 (B,G,R) or CV_8UC1
  cv::Mat depth;   ///< CV_16UC1 (PNG) or CV_32FC1 (TIFF), in units of DepthMapFactor
  std::string error;
};

/// An image from a PNG, JPEG or TIFF file as the camera took it, not turned as its EXIF tag asks: CV_8UC3
/// (B,G,R) or CV_8UC1. Throws InputError naming the file and how it is bad.
[[nodiscard]] cv::Mat read_colour_image(const std::string& path);

/// Decodes one pair from PNG, JPEG or TIFF files; never throws for bad files (missing, truncated, not an
/// image, wrong type, differing sizes): the error comes back in the result, so that a bad file costs one
/// frame and not the run.
[[nodiscard]] RgbdImages read_rgbd(const RgbdEntry& entry);

/// Decodes a list of pairs ahead of the reader in a thread of its own, so that decoding is not part of the
/// tracking time. At most `capacity` pairs (at least 1) wait in memory. next() from one thread.
class ReadAhead {
 public:
  ReadAhead(std::vector<RgbdEntry> entries, std::size_t capacity);
  ~ReadAhead();  ///< stops and joins
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// The next pair in order; false at the end of the list.
  bool next(RgbdImages& images);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
