#pragma once

#include <optional>

namespace cpslam {

/// When a pretended detector begins and when its boxes are there, counted in frame stamps alone: the same
/// frames give the same schedule on every machine.
class DetectionSchedule {
 public:
  /// rate_hz: detections begin this often on average, at every frame when 0 or above the frame rate.
  /// delay_s: the boxes are there this long after their image.
  DetectionSchedule(double rate_hz, double delay_s);

  /// Asked once for every frame, in the order of their stamps: does a detection begin at this one? A frame
  /// may come a little before its turn, so that jittery stamps do not cost a whole frame; what a detection
  /// begins too late does not put off the next one, so that the average rate is met whatever the frame rate.
  [[nodiscard]] bool begins_at(double time_s);

  /// Are the boxes of the image taken at begin_s there for the frame of now_s?
  [[nodiscard]] bool is_due(double begin_s, double now_s) const;

 private:
  double period_s_ = 0.0;
  double delay_s_ = 0.0;
  std::optional<double> next_s_;
};

}  // namespace cpslam
