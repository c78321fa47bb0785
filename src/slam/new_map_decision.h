#pragma once

#include <optional>

namespace cpslam {

/// Decides when a lost camera has looked at a place that nobody knows for long enough to begin another map
/// there. A lens that is covered sees no place: that time does not count, and what was seen before it no
/// more. A map that is lost again at once doubles the time until the next one. Not thread-safe.
class NewMapDecision {
 public:
  /// after_s: of looking; 0 for never.
  explicit NewMapDecision(double after_s) : after_s_(after_s) {}

  /// A frame that found no place. could_begin: it shows enough to begin a map with. Returns whether it
  /// should.
  [[nodiscard]] bool is_due(double time_s, bool could_begin);
  /// A frame that found its place, or began a map.
  void found(double time_s, bool keyframe);
  /// A map was begun with the frame at hand; found() follows.
  void begun();

 private:
  [[nodiscard]] double present_wait_s() const;

  double after_s_;
  double last_wait_s_ = 0.0;  // before the latest map that was begun
  double looked_s_ = 0.0;     // since the last frame that found its place
  double covered_s_ = 0.0;    // since something was to be seen
  std::optional<double> last_time_s_;
  std::optional<int> keyframes_;  // of the latest map that was begun; empty before the first
};

}  // namespace cpslam
