#pragma once

#include <optional>
#include <vector>

#include "diagnosis/agreement_map.h"

namespace cpslam::diagnosis {

struct DepthGrowth {
  double growth = 0.0;    ///< 0.05: depth must be enlarged by 5 % to lie on colour
  double gain = 0.0;      ///< agreement there, as a multiple of that without growth
  double contrast = 0.0;  ///< of the peak there
};

/// By how much depth must be enlarged to meet colour, up to 12 %: cameras of different fields of view, which
/// registration makes up for. Looks at pictures reduced to a width of 320 px.
class GrowthSearch {
 public:
  /// Images as for EdgeComparison.
  void add(const cv::Mat& grey, const cv::Mat& readings);
  /// Empty when edges meet nowhere.
  [[nodiscard]] std::optional<DepthGrowth> best() const;

 private:
  std::vector<AgreementMap> maps_;  // by growth
};

}  // namespace cpslam::diagnosis
