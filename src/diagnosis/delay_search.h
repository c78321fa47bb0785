#pragma once

#include <optional>
#include <vector>

#include "diagnosis/agreement_map.h"
#include "diagnosis/image_motion.h"

namespace cpslam::diagnosis {

/// A frame's depth edges against its colour edges.
struct FrameAgreement {
  double colour_time_s = 0.0;
  double depth_time_s = 0.0;
  AgreementMap map;  ///< centred
};

struct DepthDelay {
  double delay_s = 0.0;      ///< how much longer ago than its stamp says depth was taken
  double sigma_s = 0.0;      ///< standard deviation of that, by jackknife
  AgreementPeak with_delay;  ///< of all frames, each moved by what the delay explains
};

/// The delay of depth, up to 0.25 s to either side. Depth that was taken earlier than its stamp says lies
/// where colour's content was then; so of all delays the right one, and one shift common to all frames, make
/// the edges of most frames meet. Empty when the motion is too small, too even or too unlike to tell.
[[nodiscard]] std::optional<DepthDelay> find_depth_delay(const std::vector<FrameAgreement>& frames,
                                                         const ImageMotion& colour_motion);

}  // namespace cpslam::diagnosis
