#pragma once

#include <OpenNI.h>

#include "openni/camera_frame.h"

namespace cpslam {

/// Copies a picture out of OpenNI's memory; colour becomes B,G,R or grey, a mirrored picture is turned back.
/// Throws RunError for a picture that is not what the mode promised.
[[nodiscard]] CameraPicture copy_picture(const openni::VideoFrameRef& frame, bool mirrored);

}  // namespace cpslam
