#pragma once

#include "features/frame_features.h"
#include "optim/reprojection.h"
#include "slam/rig.h"

namespace cpslam {

/// A corner mostly lies on an object's rim, where registration errors, bleeding depth edges and the two
/// sensors' different shutters count far more than the noise of the depth sensor on a surface. So no
/// disparity is believed to better than this, at the keypoint's own pyramid level; docs/benchmarks.md has the
/// measurement behind it.
inline constexpr double kMinDisparitySigmaPx = 3.0;

/// The keypoint as a measurement: pixel noise grows with the pyramid level; the virtual disparity's noise is
/// the depth sensor's, carried through bf / depth, but no less than given (at level 0).
[[nodiscard]] PointObservation observe(const Rig& rig, const FrameFeatures& features, int keypoint,
                                       double min_disparity_sigma_px = kMinDisparitySigmaPx);

/// Where the keypoint's point lies in the camera frame (m); the keypoint must have depth.
[[nodiscard]] Eigen::Vector3d back_project(const Rig& rig, const FrameFeatures& features, int keypoint);

/// Squared error over variance of a point in the camera frame against the keypoint; infinite behind the
/// camera.
[[nodiscard]] double chi2(const Rig& rig, const PointObservation& seen,
                          const Eigen::Vector3d& point_in_camera);

/// Level of the pyramid at which a point at this distance looks as it did in its reference view.
[[nodiscard]] int predict_octave(const Rig& rig, double distance_m, float max_distance_m);

}  // namespace cpslam
