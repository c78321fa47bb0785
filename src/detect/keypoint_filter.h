#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "cpslam/types.h"
#include "detect/grid_camera.h"
#include "detect/person_fit.h"
#include "detect/person_track.h"
#include "util/random.h"

namespace cpslam {

/// Which keypoints are on people: 1 for those, 0 for the others; parallel to the keypoints. A keypoint is on
/// a person when it lies on his surface, rim included, at his depth. One without depth is when his surface is
/// next to it, or when it is in his box and nothing around it has a depth either; but not where the sensor
/// sees nothing because he throws his shadow there, unless his outline is a guess.
[[nodiscard]] std::vector<std::uint8_t> find_keypoints_on_people(const GridCamera& camera,
                                                                 const cv::Mat1f& depth_m,
                                                                 const std::vector<PersonTrack>& tracks,
                                                                 double depth_lag_s,
                                                                 std::span<const DepthKeypoint> keypoints);

/// Of the keypoints, those on the surface of people who have not moved for some seconds (1): as good as
/// furniture, for now. still_age: StillSurface::age. The depths say so cell by cell, and the flow of his
/// keypoints for the whole person: a flat torso that slides sideways looks still to the depth camera.
[[nodiscard]] std::vector<std::uint8_t> find_keypoints_on_resting_people(
    const GridCamera& camera, const cv::Mat1b& still_age, const std::vector<PersonTrack>& tracks,
    std::span<const DepthKeypoint> keypoints);

/// The keypoints on people by deleting all that is in a box.
[[nodiscard]] std::vector<std::uint8_t> find_keypoints_in_boxes(std::span<const PersonBox> boxes,
                                                                std::span<const DepthKeypoint> keypoints);

/// The keypoints on people by Algorithm 1 of the CP-SLAM paper as literally as it can be read
/// (docs/method.md): for comparison.
[[nodiscard]] std::vector<std::uint8_t> find_keypoints_as_published(std::span<const PersonBox> boxes,
                                                                    std::span<const DepthKeypoint> keypoints,
                                                                    Random& random);

}  // namespace cpslam
