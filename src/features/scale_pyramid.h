#pragma once

#include <cmath>
#include <vector>

namespace cpslam {

/// Scale factors of the feature pyramid: factor[i] = scale_factor^i.
struct ScalePyramid {
  ScalePyramid(double scale_factor, int n_levels) : log_factor(std::log(scale_factor)) {
    double f = 1.0;
    for (int i = 0; i < n_levels; ++i, f *= scale_factor) factor.push_back(static_cast<float>(f));
  }
  [[nodiscard]] int n_levels() const { return static_cast<int>(factor.size()); }

  double log_factor;
  std::vector<float> factor;
};

}  // namespace cpslam
