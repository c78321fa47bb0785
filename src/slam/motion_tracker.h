#pragma once

#include "map/map.h"
#include "slam/frame.h"
#include "slam/rig.h"

namespace cpslam {

/// Gives the close keypoints of a finished frame that no map point explains a temporary point from their
/// depth.
void add_temporary_points(const Rig& rig, Frame& frame);

/// Brings a past frame up to date with the map: it takes the given pose, its matches get the points' present
/// positions; what has been erased goes on as a temporary point, and temporary points move with the camera.
/// The caller holds a shared lock of the map.
void refresh_frame(const Map& map, const SE3& cam_from_world, Frame& frame);

/// Finds the points of the last frame in this one around where the predicted pose (in frame.cam_from_world)
/// puts them, in windows of radius_px at pyramid level 0, and optimises the pose. Returns the inliers of any
/// kind; on fewer than ten the frame is left without matches and with the predicted pose.
int track_from_last_frame(const Rig& rig, const Frame& last, float radius_px, Frame& frame);

}  // namespace cpslam
