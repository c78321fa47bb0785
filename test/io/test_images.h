#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "util/random.h"

namespace cpslam {

/// A noisy image: the encoded file has no empty stretches.
inline cv::Mat noise_image(cv::Size size, int type, std::uint64_t seed = 1) {
  Random random(seed);
  cv::Mat image(size, type);
  const std::size_t row_bytes = static_cast<std::size_t>(size.width) * image.elemSize();
  for (int y = 0; y < size.height; ++y) {
    if (image.depth() == CV_32F) {
      for (int x = 0; x < size.width; ++x)
        image.at<float>(y, x) = static_cast<float>(random.uniform(0.5, 4.0));
    } else {
      for (std::size_t i = 0; i < row_bytes; ++i)
        image.ptr(y)[i] = static_cast<unsigned char>(random.index(256));
    }
  }
  return image;
}

/// The bytes of an image file.
inline std::string encode(const std::string& extension, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(extension, image, bytes)) throw std::runtime_error("cannot encode " + extension);
  return {bytes.begin(), bytes.end()};
}

}  // namespace cpslam
