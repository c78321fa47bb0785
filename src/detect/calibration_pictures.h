#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace cpslam {

/// At most `count` pictures (B,G,R) of a folder, evenly spread over its .png, .jpg and .jpeg files in the
/// order of their names, letterboxed into `input` px. Throws InputError naming the folder when there are
/// none, or the file that cannot be read.
[[nodiscard]] std::vector<cv::Mat> read_calibration_pictures(const std::string& folder, std::size_t count,
                                                             cv::Size input);

}  // namespace cpslam
