#pragma once

#include <opencv2/core/types.hpp>
#include <string>

namespace cpslam::viewer {

/// Writes what has been drawn, and is not shown yet, into a PNG file. Throws RunError naming the file.
void save_drawn(const std::string& path, cv::Size size);

}  // namespace cpslam::viewer
