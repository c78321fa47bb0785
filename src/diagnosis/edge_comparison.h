#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "diagnosis/agreement_map.h"

namespace cpslam::diagnosis {

/// Edges of one frame, found once and compared as often as one likes.
class EdgeComparison {
 public:
  /// grey: CV_8UC1; readings: CV_32FC1 of the same size, 0: none. Shifts up to 5 % of the width are compared.
  EdgeComparison(const cv::Mat& grey, const cv::Mat& readings);

  /// An empty map of the range for pictures of this size.
  [[nodiscard]] static AgreementMap make_map(cv::Size size);

  /// Adds to the map (of make_map) how the edges agree when depth is enlarged by the factor 1 + growth about
  /// the picture's middle.
  void add_to(AgreementMap& map, double growth = 0.0) const;

 private:
  cv::Size size_;
  std::vector<cv::Point> depth_across_, depth_down_;
  cv::Mat colour_across_, colour_down_;
};

}  // namespace cpslam::diagnosis
