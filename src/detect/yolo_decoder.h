#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

struct YoloThresholds {
  double confidence = 0.45;
  double overlap = 0.45;  ///< intersection over union
};

/// The boxes in the outputs of a network's YOLO heads, px of the input, most confident first. outputs: per
/// head CV_32FC1, a row a box: centre x, y, width, height as shares of the input's sides, objectness,
/// objectness * class score of every class. A box counts as the best of the given classes (indices). Of boxes
/// that overlap the most confident stays, whatever their classes: a box here says where something moves, not
/// what. Boxes that are not finite or lie beside the input are left out; none reaches further over the
/// input's border than the input's side.
[[nodiscard]] std::vector<PersonBox> decode_yolo(const std::vector<cv::Mat>& outputs, cv::Size input,
                                                 const std::vector<int>& classes,
                                                 const YoloThresholds& thresholds);

}  // namespace cpslam
