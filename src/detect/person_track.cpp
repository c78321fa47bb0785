#include "detect/person_track.h"

#include <algorithm>
#include <cmath>

#include "detect/still_surface.h"

namespace cpslam {

void age_velocity(double dt_s, PersonTrack& track) {
  constexpr float kAccelerationMPerS2 = 3.0F;
  const float change = kAccelerationMPerS2 * static_cast<float>(dt_s);
  track.velocity_variance.array() += change * change;
}

void measure_velocity(const Eigen::Vector3f& measured_m_per_s, const Eigen::Vector3f& sigma_m_per_s,
                      PersonTrack& track) {
  const Eigen::Array3f gain =
      track.velocity_variance.array() / (track.velocity_variance.array() + sigma_m_per_s.array().square());
  track.velocity_m_per_s.array() += gain * (measured_m_per_s - track.velocity_m_per_s).array();
  track.velocity_variance.array() *= 1.0F - gain;
}

bool is_walking(const PersonTrack& track) {
  constexpr float kWalkingMPerS = 0.25F;
  const float speed = track.velocity_m_per_s.norm();
  return speed > kWalkingMPerS && speed > 2.0F * std::sqrt(track.velocity_variance.maxCoeff());
}

int passing_frames(const PersonTrack& track, double dt_s) {
  constexpr double kBodyWidthM = 0.5;
  constexpr double kFewest = StillSurface::kStillAge;
  constexpr double kMost = 60.0;
  if (!is_walking(track)) return StillSurface::kRecentAge;
  return static_cast<int>(
      std::clamp(kBodyWidthM / static_cast<double>(track.velocity_m_per_s.norm()) / dt_s, kFewest, kMost));
}

bool is_resting(const PersonTrack& track) {
  constexpr float kRestingMPerS = 0.2F;
  return track.velocity_m_per_s.norm() + std::sqrt(track.velocity_variance.maxCoeff()) < kRestingMPerS;
}

cv::Mat1b paint_people(const std::vector<PersonTrack>& tracks, cv::Size grid_size) {
  cv::Mat1b labels(grid_size, std::uint8_t{0});
  for (const PersonTrack& track : tracks) {
    for (const int cell : track.visible.cells) labels(cell) = track.number;
  }
  return labels;
}

}  // namespace cpslam
