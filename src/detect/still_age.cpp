#include "detect/still_age.h"

#include <algorithm>
#include <cmath>

#include "camera/depth_noise.h"

namespace cpslam {

float still_tolerance_m(float depth_m) {
  return 0.02F + 4.0F * static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
}

cv::Mat1b carry_still_age(const GridCamera& camera, const cv::Mat1f& previous_depth_m,
                          const cv::Mat1b& previous_age, const cv::Mat1f& depth_m,
                          const SE3& this_from_previous) {
  constexpr int kOldest = 250;
  const FloatTransform move(this_from_previous);
  cv::Mat1f expected_m(depth_m.size(), 0.0F);
  cv::Mat1b age(depth_m.size(), kUnknownStillAge);
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    if (previous_depth_m(cell) <= 0.0F) continue;
    const Eigen::Vector3f moved = move * camera.point(cell, previous_depth_m(cell));
    const int there = camera.cell_of(moved);
    if (there < 0 || (expected_m(there) > 0.0F && expected_m(there) <= moved.z())) continue;
    expected_m(there) = moved.z();
    age(there) = previous_age(cell);
  }
  for (int cell = 0; cell < camera.n_cells(); ++cell) {
    const float known_m = expected_m(cell);
    if (known_m <= 0.0F || depth_m(cell) <= 0.0F) continue;
    const float nearer_m = known_m - depth_m(cell);
    if (std::abs(nearer_m) < still_tolerance_m(known_m)) {
      age(cell) = static_cast<std::uint8_t>(std::min(kOldest, age(cell) + 1));
    } else {
      age(cell) = nearer_m > 0.0F ? std::uint8_t{0} : kUnknownStillAge;
    }
  }
  return age;
}

}  // namespace cpslam
