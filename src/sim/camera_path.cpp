#include "sim/camera_path.h"

#include <cmath>
#include <numbers>

#include "sim/rooms.h"
#include "sim/smooth_curve.h"

namespace cpslam::sim {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

double smooth_step(double x) {
  x = std::min(1.0, std::max(0.0, x));
  return x * x * (3.0 - 2.0 * x);
}

/// Two sines of incommensurate periods: never quite the same twice.
class Sway {
 public:
  Sway(double amplitude, double period_s, Random& random)
      : amplitude_(amplitude),
        rate_(2.0 * kPi / (period_s * random.uniform(0.95, 1.05))),
        phase_(random.uniform(0.0, 2.0 * kPi)),
        second_phase_(random.uniform(0.0, 2.0 * kPi)) {}
  [[nodiscard]] double at(double time_s) const {
    return amplitude_ * (0.85 * std::sin(rate_ * time_s + phase_) +
                         0.15 * std::sin(std::numbers::phi * rate_ * time_s + second_phase_));
  }

 private:
  double amplitude_, rate_, phase_, second_phase_;
};

/// The tremor of a hand: 1.2 to 4 Hz.
class Tremor {
 public:
  Tremor(double position_m, double angle_rad, Random& random) {
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      for (Wave& wave : axes_[axis]) {
        wave.rate = 2.0 * kPi * random.uniform(1.2, 4.0);
        wave.phase = random.uniform(0.0, 2.0 * kPi);
        wave.amplitude = (axis < 3 ? position_m : angle_rad) * random.uniform(0.2, 0.5);
      }
    }
  }
  [[nodiscard]] SE3 at(double time_s) const {
    Eigen::Matrix<double, 6, 1> twist;
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
      double value = 0.0;
      for (const Wave& wave : axes_[axis])
        value += wave.amplitude * std::sin(wave.rate * time_s + wave.phase);
      twist[static_cast<Eigen::Index>(axis)] = value;
    }
    return SE3::exp(twist);
  }

 private:
  struct Wave {
    double amplitude, rate, phase;
  };
  std::array<std::array<Wave, 3>, 6> axes_{};
};

/// In front of the office's desks: static, xyz and rpy.
class BasePath : public CameraPath {
 public:
  BasePath(double amplitude_m, double amplitude_rad, const Tremor& tremor, Random& random)
      : base_(0.85 + random.uniform(-0.08, 0.08), OfficePlan::kMiddle_y + random.uniform(-0.2, 0.2),
              1.4 + random.uniform(-0.05, 0.05)),
        x_(amplitude_m, 12.3, random),
        y_(amplitude_m, 10.7, random),
        z_(0.7 * amplitude_m, 8.9, random),
        roll_(amplitude_rad, 7.9, random),
        pitch_(amplitude_rad, 6.7, random),
        yaw_(amplitude_rad, 5.3, random),
        tremor_(tremor) {}
  [[nodiscard]] SE3 world_from_camera(double t) const override {
    const Eigen::Vector3d position = base_ + Eigen::Vector3d(x_.at(t), y_.at(t), z_.at(t));
    const SE3 base = looking_along(position, {1.0, 0.0, -0.2});
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(yaw_.at(t), Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(pitch_.at(t), Eigen::Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(roll_.at(t), Eigen::Vector3d::UnitZ()))
                                     .toRotationMatrix();
    return base * SE3(turn, Eigen::Vector3d::Zero()) * tremor_.at(t);
  }

 private:
  Eigen::Vector3d base_;
  Sway x_, y_, z_, roll_, pitch_, yaw_;
  Tremor tremor_;
};

class HalfspherePath : public CameraPath {
 public:
  explicit HalfspherePath(Random& random)
      : azimuth_(60.0 * kDegree, 16.0, random),
        elevation_(16.0 * kDegree, 9.7, random),
        radius_(0.08, 12.1, random),
        tremor_(0.002, 0.15 * kDegree, random) {}
  [[nodiscard]] SE3 world_from_camera(double t) const override {
    const Eigen::Vector3d centre(OfficePlan::kDeskFront_x + 0.4, OfficePlan::kMiddle_y,
                                 OfficePlan::kDeskHeight_m);
    const double azimuth = azimuth_.at(t);
    const double elevation = 37.0 * kDegree + elevation_.at(t);
    const double radius = 1.05 + radius_.at(t);
    const Eigen::Vector3d out(-std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    const Eigen::Vector3d position = centre + radius * out;
    const Eigen::Vector3d target = centre + Eigen::Vector3d(0.5, 0.0, 0.15);
    return looking_along(position, target - position) * tremor_.at(t);
  }

 private:
  Sway azimuth_, elevation_, radius_;
  Tremor tremor_;
};

/// Walking along a curve: looks ahead, turned by a constant angle, and about a little.
class WalkPath : public CameraPath {
 public:
  WalkPath(SmoothCurve curve, double speed_mps, double start_m, double turn_rad, Random& random)
      : curve_(std::move(curve)),
        speed_mps_(speed_mps),
        start_m_(start_m),
        turn_rad_(turn_rad),
        bob_(0.012, 0.62, random),
        look_about_(10.0 * kDegree, 6.1, random),
        nod_(4.0 * kDegree, 4.7, random),
        tremor_(0.003, 0.25 * kDegree, random) {}
  [[nodiscard]] SE3 world_from_camera(double t) const override {
    const double s = start_m_ + speed_mps_ * t;
    const Eigen::Vector2d at = curve_.position(s);
    const Eigen::Vector2d ahead = curve_.direction(s + 0.35, 1.4);
    const double yaw = std::atan2(ahead.y(), ahead.x()) + turn_rad_ + look_about_.at(t);
    const double pitch = -9.0 * kDegree + nod_.at(t);
    const Eigen::Vector3d forward(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                                  std::sin(pitch));
    return looking_along({at.x(), at.y(), 1.42 + bob_.at(t)}, forward) * tremor_.at(t);
  }

 private:
  SmoothCurve curve_;
  double speed_mps_, start_m_, turn_rad_;
  Sway bob_, look_about_, nod_;
  Tremor tremor_;
};

class TwinsPath : public CameraPath {
 public:
  explicit TwinsPath(Random& random)
      : x_(0.12, 5.3, random),
        y_(0.3, 6.1, random),
        z_(0.12, 4.7, random),
        tremor_(0.002, 0.15 * kDegree, random) {}
  [[nodiscard]] SE3 world_from_camera(double t) const override {
    const double phase = std::fmod(t, 2.0 * (kStay_s + kGo_s));
    const double there = smooth_step((phase - kStay_s) / kGo_s);
    const double back = smooth_step((phase - 2.0 * kStay_s - kGo_s) / kGo_s);
    // Turns by the north wall on the way there and on by the south wall on the way back.
    const double yaw = kPi * (1.0 - there - back);
    const double middle = 0.5 * TwinPlan::kLength_m;
    const Eigen::Vector3d position(middle + (middle - 1.75) * (2.0 * (there - back) - 1.0) + x_.at(t),
                                   0.5 * TwinPlan::kDepth_m + y_.at(t), 1.35 + z_.at(t));
    return looking_along(position, {std::cos(yaw), std::sin(yaw), -0.22}) * tremor_.at(t);
  }

 private:
  static constexpr double kStay_s = 6.0, kGo_s = 10.0;
  Sway x_, y_, z_;
  Tremor tremor_;
};

std::unique_ptr<CameraPath> make_rounds(Random& random) {
  constexpr double kFront = 1.7, kBack = 5.5, kSouth = 0.62, kNorth = 4.98;
  const std::vector<Eigen::Vector2d> corners{{kFront, 1.5}, {kFront, 4.1}, {2.4, kNorth}, {4.8, kNorth},
                                             {kBack, 4.1},  {kBack, 1.5},  {4.8, kSouth}, {2.4, kSouth}};
  // Clockwise, with the desks on the right.
  return std::make_unique<WalkPath>(SmoothCurve(corners, true), 0.6, random.uniform(0.0, 2.0),
                                    -40.0 * kDegree, random);
}

std::unique_ptr<CameraPath> make_ring(Random& random) {
  constexpr double kX = RingPlan::kCellX_m, kY = RingPlan::kCellY_m;
  constexpr double kLow = 0.5 * kY - RingPlan::kDoorOffset_m, kHigh = 1.5 * kY + RingPlan::kDoorOffset_m;
  std::vector<Eigen::Vector2d> points;
  const auto straight_through = [&](double x, double y, double dx, double dy) {
    for (const double step : {-0.6, 0.0, 0.6}) points.emplace_back(x + step * dx, y + step * dy);
  };
  straight_through(kX, kLow, 1, 0);
  points.emplace_back(1.5 * kX, kLow + random.uniform(0.2, 0.5));
  straight_through(2 * kX, kLow, 1, 0);
  points.emplace_back(2.36 * kX, 0.66 * kY);
  straight_through(2.5 * kX, kY, 0, 1);
  points.emplace_back(2.36 * kX, 1.34 * kY);
  straight_through(2 * kX, kHigh, -1, 0);
  points.emplace_back(1.5 * kX, kHigh - random.uniform(0.2, 0.5));
  straight_through(kX, kHigh, -1, 0);
  points.emplace_back(0.64 * kX, 1.34 * kY);
  straight_through(0.5 * kX, kY, 0, -1);
  points.emplace_back(0.64 * kX, 0.66 * kY);
  SmoothCurve curve(points, true);
  const double start = curve.closest({1.5 * kX, kLow + 0.3}) - 1.2;
  return std::make_unique<WalkPath>(std::move(curve), 0.62, start, 0.0, random);
}

}  // namespace

SE3 looking_along(const Eigen::Vector3d& position, const Eigen::Vector3d& forward) {
  const Eigen::Vector3d z = forward.normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d rotation;
  rotation << x, z.cross(x), z;
  return {rotation, position};
}

std::unique_ptr<CameraPath> make_camera_path(PathKind kind, Random& random) {
  switch (kind) {
    case PathKind::kStatic:
      return std::make_unique<BasePath>(0.003, 0.3 * kDegree, Tremor(0.0006, 0.04 * kDegree, random), random);
    case PathKind::kXyz:
      return std::make_unique<BasePath>(0.48, 3.0 * kDegree, Tremor(0.002, 0.15 * kDegree, random), random);
    case PathKind::kRpy:
      return std::make_unique<BasePath>(0.03, 25.0 * kDegree, Tremor(0.002, 0.15 * kDegree, random), random);
    case PathKind::kHalfsphere:
      return std::make_unique<HalfspherePath>(random);
    case PathKind::kRounds:
      return make_rounds(random);
    case PathKind::kRingTour:
      return make_ring(random);
    case PathKind::kTwins:
      break;
  }
  return std::make_unique<TwinsPath>(random);
}

}  // namespace cpslam::sim
