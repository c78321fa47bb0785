#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detect/grid_camera.h"
#include "detect/person_track.h"

namespace cpslam {

/// Per-pixel mask of the people: CV_8UC1 of the camera's size, 0 nobody, else the person's number. The cells
/// of the tracks, their outline decided by pixel from the depth image (CV_16UC1 or CV_32FC1): a pixel in or
/// next to a person's cell belongs to him when it is at his depth, or has none. Thread-safe.
[[nodiscard]] cv::Mat1b person_mask(const GridCamera& camera, const std::vector<PersonTrack>& tracks,
                                    const cv::Mat& depth, double metres_per_unit);

}  // namespace cpslam
