#pragma once

#include <vector>

#include "detect/grid_camera.h"
#include "detect/keypoint_flow.h"
#include "detect/person_track.h"
#include "geometry/se3.h"

namespace cpslam {

/// Measures how each person moved between two frames from the flow of the keypoints on him: matched by
/// appearance near where he is expected, lifted by their depths, freed of the camera's motion; the median of
/// the displacements corrects the velocity. previous_people: paint_people of the tracks in the previous
/// frame; tracks: already carried into this one.
void follow_keypoints(const GridCamera& camera, const FlowKeypoints& previous,
                      const cv::Mat1b& previous_people, const FlowKeypoints& current,
                      const SE3& this_from_previous, double dt_s, std::vector<PersonTrack>& tracks);

}  // namespace cpslam
