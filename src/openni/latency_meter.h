#pragma once

#include <chrono>
#include <optional>

namespace cpslam {

/// How long ago a frame was taken. The camera's clock and ours have nothing in common but their pace, so the
/// quickest arrival lately counts as one without delay: what is constant in the camera and its cable is not
/// in the figure. One thread.
class LatencyMeter {
 public:
  using HostTime = std::chrono::steady_clock::time_point;

  /// From the frame's stamp to now, ms.
  double add(double time_s, HostTime arrived, HostTime now);

 private:
  std::optional<double> least_delay_s_;  // of arrival behind the stamp, the clocks' offset included
  double last_time_s_ = 0.0;
};

}  // namespace cpslam
