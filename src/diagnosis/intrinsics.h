#pragma once

#include "cpslam/settings.h"
#include "diagnosis/finding.h"

namespace cpslam::diagnosis {

/// Whether a calibration can be that of a camera with pictures of this size: size, field of view, squareness
/// of the pixels, principal point, distortion, baseline.
[[nodiscard]] Findings check_intrinsics(const CameraSettings& camera, int picture_width, int picture_height);

}  // namespace cpslam::diagnosis
