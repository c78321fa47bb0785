#pragma once

#include <optional>
#include <vector>

#include "sim/person_scripts.h"
#include "sim/smooth_curve.h"

namespace cpslam::sim {

/// Something done while standing still.
struct Stop {
  double at_m = 0.0;  ///< distance on the walker's curve
  double duration_s = 3.0;
  double facing_rad = 0.0;                                 ///< yaw, world
  bool gesture = false;                                    ///< talks with the right hand
  std::array<std::optional<Eigen::Vector3d>, 2> hands_on;  ///< world; left, right
};

/// Walks round a closed curve, with stops.
class WalkerScript : public PersonScript {
 public:
  WalkerScript(SmoothCurve curve, double speed_mps, std::vector<Stop> stops, double start_s);
  [[nodiscard]] Posture posture(double time_s, const BodyShape& shape) const override;

 private:
  struct Leg {  // a walk, then the stop at its end
    double begin_s, walk_s, begin_m, length_m;
    std::optional<Stop> stop;
  };
  struct Progress {
    double distance_m, pace;  // pace: 1 at full speed
    const Stop* stop;
    double stop_weight;  // how far the stop's posture is taken, 0 to 1
  };
  [[nodiscard]] Progress progress(double time_s) const;

  SmoothCurve curve_;
  double speed_mps_, start_s_;
  std::vector<Leg> legs_;
  double round_s_ = 0.0;
};

/// Sits or stands in one place, busy with hands, torso and head.
class StationaryScript : public PersonScript {
 public:
  struct Place {
    Eigen::Vector2d at;
    double facing_rad;
    bool sitting;
    std::array<std::optional<Eigen::Vector3d>, 2> hands_on;  ///< world; left, right
  };
  StationaryScript(const Place& place, Random& random);
  [[nodiscard]] Posture posture(double time_s, const BodyShape& shape) const override;

 private:
  Place place_;
  double phase_, gesture_period_s_;
};

}  // namespace cpslam::sim
