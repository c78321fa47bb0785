#pragma once

#include <span>
#include <vector>

#include "detect/grid_camera.h"
#include "detect/person_fit.h"
#include "detect/person_track.h"
#include "detect/still_surface.h"
#include "util/random.h"

namespace cpslam {

/// Brings the people carried into a frame together with the boxes found in its image: boxes are fitted to the
/// depths (fit_people), matched to the people they overlap most, and start a new person where they match
/// none. Who has been missed by several detections in a row, and for some time, is forgotten: a missed
/// detection (someone tilted, half out of the image) does not free his keypoints at once.
void confirm_people(const GridCamera& camera, const cv::Mat1f& depth_m, const StillSurface& still,
                    double time_s, std::span<const PersonBox> boxes, std::span<const DepthKeypoint> keypoints,
                    Random& random, std::vector<PersonTrack>& tracks);

/// Takes moving surfaces in: as a part of the one they hang on, or else as people nobody has detected yet,
/// until a detection confirms them or they stand still.
void add_blobs(const cv::Mat1f& depth_m, const std::vector<GridSurface>& blobs, double time_s,
               std::vector<PersonTrack>& tracks);

/// Takes from those who walk what has stood still for longer than they need to pass by: furniture that a fit
/// took for a part of them. dt_s: between frames.
void drop_what_stays(const StillSurface& still, double dt_s, std::vector<PersonTrack>& tracks);

/// Forgets who has not been found again for some time, has left the image, or has not been detected for long
/// (the detector may have died); and what moved without being detected as
/// a person once it stands still.
void forget_people(double time_s, const cv::Mat1b& still_age, std::vector<PersonTrack>& tracks);

}  // namespace cpslam
