#pragma once

#include <vector>

#include "detect/person_track.h"
#include "detect/still_surface.h"

namespace cpslam {

/// Surfaces that have come before what stood still, without anybody having detected a person there yet:
/// connected cells that have just arrived, where nobody is known (people: paint_people). Only what is large
/// enough to be somebody, and somewhere wider than two rims of rim_cells: those of furniture flicker, the
/// more the quicker the camera moves.
[[nodiscard]] std::vector<GridSurface> find_moving_blobs(const cv::Mat1f& depth_m, const cv::Mat1b& still_age,
                                                         const cv::Mat1b& people, int rim_cells);

}  // namespace cpslam
