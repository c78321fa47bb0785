#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "detect/grid_camera.h"
#include "detect/keypoint_flow.h"
#include "geometry/se3.h"

namespace cpslam {

/// How the camera moved between two frames, by the flow of the keypoints on nobody: a pose-only solution
/// against the previous frame's depths, from where the motion is expected. Tracking finds it better, against
/// the map, but only after the people have been told from the room; and what a camera that starts to turn is
/// expected to do would be taken for their velocity. Nothing when too few keypoints agree.
/// previous_people: paint_people of the tracks in the previous frame.
[[nodiscard]] std::optional<SE3> measure_camera_motion(const GridCamera& camera,
                                                       const FlowKeypoints& previous,
                                                       const cv::Mat1b& previous_people,
                                                       const FlowKeypoints& current,
                                                       const SE3& expected_this_from_previous);

}  // namespace cpslam
