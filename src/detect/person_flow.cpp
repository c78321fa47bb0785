#include "detect/person_flow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "camera/depth_noise.h"
#include "util/median.h"

namespace cpslam {
namespace {

constexpr std::size_t kMinMatches = 4;
constexpr float kAgreeM = 0.06F;     // with the median displacement
constexpr float kKeypointPx = 1.0F;  // how well a keypoint is localised
constexpr float kMaxSpeedMPerS = 4.0F;

Eigen::Vector3f median_by_axis(const std::vector<Eigen::Vector3f>& vectors) {
  Eigen::Vector3f result;
  std::vector<float> values(vectors.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(vectors.begin(), vectors.end(), values.begin(), [axis](const auto& v) { return v[axis]; });
    result[axis] = median(values);
  }
  return result;
}

/// Displacements of a person's keypoints, and the sum of their depths.
struct Displacements {
  std::vector<Eigen::Vector3f> moved;
  float depth_sum_m = 0.0F;
};

void correct_velocity(const Displacements& displacements, float focal_px, double dt_s, PersonTrack& track) {
  const auto n = displacements.moved.size();
  if (n < kMinMatches) return;
  const Eigen::Vector3f middle = median_by_axis(displacements.moved);
  const float depth_m = displacements.depth_sum_m / static_cast<float>(n);
  const auto noise_m = static_cast<float>(structured_light_sigma_m(static_cast<double>(depth_m)));
  const auto agreeing =
      std::count_if(displacements.moved.begin(), displacements.moved.end(),
                    [&](const Eigen::Vector3f& d) { return (d - middle).norm() < kAgreeM + 2.0F * noise_m; });
  if (2 * agreeing < static_cast<std::ptrdiff_t>(n)) return;
  const auto seconds = static_cast<float>(dt_s);
  const Eigen::Vector3f measured = middle / seconds;
  if (measured.norm() > kMaxSpeedMPerS) return;
  // A median is some 1.25 times as uncertain as a mean; both frames err.
  const float spread = 1.25F * std::sqrt(2.0F / static_cast<float>(agreeing)) / seconds;
  const float across = spread * kKeypointPx * depth_m / focal_px;
  measure_velocity(measured, {across, across, spread * noise_m}, track);
}

}  // namespace

void follow_keypoints(const GridCamera& camera, const FlowKeypoints& previous,
                      const cv::Mat1b& previous_people, const FlowKeypoints& current,
                      const SE3& this_from_previous, double dt_s, std::vector<PersonTrack>& tracks) {
  if (tracks.empty() || dt_s <= 0.0) return;
  const KeypointFlow flow(camera.camera(), current);
  const FloatTransform move(this_from_previous);
  std::vector<Displacements> displacements(tracks.size());
  for (std::size_t i = 0; i < previous.keypoints.size(); ++i) {
    const DepthKeypoint& k = previous.keypoints[i];
    const int cell = k.depth_m > 0.0F ? camera.cell_of_pixel(k.x, k.y) : -1;
    if (cell < 0 || previous_people(cell) == 0) continue;
    const auto track = std::find_if(tracks.begin(), tracks.end(),
                                    [&](const PersonTrack& t) { return t.number == previous_people(cell); });
    if (track == tracks.end()) continue;
    const Eigen::Vector3f unmoved = move * lift(camera.camera(), k);
    const Eigen::Vector3f expected = unmoved + track->velocity_m_per_s * static_cast<float>(dt_s);
    const int match = flow.find(expected, previous.descriptors[i]);
    if (match < 0) continue;
    Displacements& his = displacements[static_cast<std::size_t>(track - tracks.begin())];
    his.moved.emplace_back(lift(camera.camera(), current.keypoints[static_cast<std::size_t>(match)]) -
                           unmoved);
    his.depth_sum_m += k.depth_m;
  }
  for (std::size_t t = 0; t < tracks.size(); ++t)
    correct_velocity(displacements[t], static_cast<float>(camera.camera().fx()), dt_s, tracks[t]);
}

}  // namespace cpslam
