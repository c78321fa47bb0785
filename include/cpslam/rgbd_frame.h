#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// One frame for System::track().
struct RgbdFrame {
  cv::Mat colour;  ///< CV_8UC3 (B,G,R as OpenCV reads it) or CV_8UC1
  cv::Mat depth;  ///< CV_16UC1 or CV_32FC1 in units of depth_map_factor, registered to colour; 0 or NaN: none
  double time_s = 0.0;                 ///< of the colour image; grows from frame to frame
  std::optional<double> depth_time_s;  ///< when the camera stamps its depth images apart
  /// What the caller's own detector found in this colour image: people or other things that move by
  /// themselves. Even an empty list stands in the place of System's detector for this frame.
  std::optional<std::vector<PersonBox>> boxes;
  /// Non-zero where something moves by itself: CV_8UC1 of the images' size; empty when not known. What it
  /// covers is removed from this frame, besides what the boxes say; it is not carried into later ones.
  cv::Mat moving_mask;
};

/// What System saw in its latest frame, to be drawn.
struct FrameView {
  enum class Kind {
    kKept,     ///< on something static, but on no map point
    kTracked,  ///< holds a map point of the pose
    kRemoved,  ///< on a person
  };
  struct SeenKeypoint {
    float x = 0.0F;  ///< px of the image as the camera took it
    float y = 0.0F;
    Kind kind = Kind::kKept;
  };
  double time_s = 0.0;
  std::vector<SeenKeypoint> keypoints;
  std::vector<PersonBox> boxes;        ///< the newest that the frame could use
  std::optional<double> boxes_time_s;  ///< stamp of the image they were found in; empty: none so far
  cv::Mat
      person_mask;  ///< CV_8UC1 of the images' size: 0 nobody, else one number per person; empty: no detector
};

}  // namespace cpslam
