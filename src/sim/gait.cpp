#include "sim/gait.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cpslam::sim {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr double kRamp_s = 0.6;    // from standing to walking
constexpr double kSettle_s = 0.9;  // from arriving to what one came for
constexpr double kHipSwing = 24.0 * kDegree;
constexpr double kSeatHeight_m = 0.48;

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

Eigen::Matrix3d yawed(double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// A leg at a phase of the step; its hip is foremost at pi/2 and swings forward around 0.
Posture::Leg stepping_leg(double phase, double pace) {
  Posture::Leg leg;
  const double sine = std::sin(phase);
  const double lift = std::max(0.0, std::cos(phase + 0.35));
  leg.hip_pitch = pace * (kHipSwing * sine + 3.0 * kDegree);
  leg.hip_roll = 2.0 * kDegree;
  leg.knee = 4.0 * kDegree + pace * (6.0 + 50.0 * lift * lift) * kDegree;
  leg.foot_pitch = pace * 20.0 * kDegree * sine * std::abs(sine);
  return leg;
}

// A hand that underlines what is said.
Eigen::Vector3d talking_hand(const SE3& world_from_pelvis, double time_s) {
  return world_from_pelvis * Eigen::Vector3d(0.34 + 0.08 * std::sin(4.1 * time_s),
                                             -0.2 + 0.14 * std::sin(2.9 * time_s),
                                             0.32 + 0.12 * std::sin(3.7 * time_s + 1.0));
}

void set_goal(Posture::Arm& arm, const Eigen::Vector3d& goal, double weight) {
  arm.hand_goal_in_world = goal;
  arm.goal_weight = weight;
}

double angle_between(double from, double to) {
  return std::remainder(to - from, 2.0 * kPi);
}

}  // namespace

WalkerScript::WalkerScript(SmoothCurve curve, double speed_mps, std::vector<Stop> stops, double start_s)
    : curve_(std::move(curve)), speed_mps_(speed_mps), start_s_(start_s) {
  std::sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.at_m < b.at_m; });
  const double length = curve_.length_m();
  if (stops.empty()) {
    legs_.push_back({0.0, length / speed_mps_, 0.0, length, std::nullopt});
    round_s_ = legs_.front().walk_s;
    return;
  }
  double from = stops.back().at_m - length;
  for (const Stop& stop : stops) {
    Leg leg{round_s_, (stop.at_m - from) / speed_mps_ + kRamp_s, from, stop.at_m - from, stop};
    round_s_ += leg.walk_s + stop.duration_s;
    from = stop.at_m;
    legs_.push_back(leg);
  }
}

WalkerScript::Progress WalkerScript::progress(double time_s) const {
  const double t = std::fmod(time_s + start_s_, round_s_);
  const Leg* leg = &legs_.front();
  for (const Leg& candidate : legs_)
    if (candidate.begin_s <= t) leg = &candidate;
  const double since = t - leg->begin_s;
  if (!leg->stop) return {leg->begin_m + speed_mps_ * since, 1.0, nullptr, 0.0};
  if (since >= leg->walk_s) {
    const double stopped = since - leg->walk_s;
    const double weight =
        smooth_step(stopped / kSettle_s) * smooth_step((leg->stop->duration_s - stopped) / kSettle_s);
    return {leg->begin_m + leg->length_m, 0.0, &*leg->stop, weight};
  }
  // Speed rises and falls linearly within the ramps.
  const double until = leg->walk_s - since;
  const double pace = std::clamp(std::min(since, until) / kRamp_s, 0.0, 1.0);
  double distance = speed_mps_ * (since - 0.5 * kRamp_s);
  if (since < kRamp_s) distance = 0.5 * speed_mps_ * since * since / kRamp_s;
  if (until < kRamp_s) distance = leg->length_m - 0.5 * speed_mps_ * until * until / kRamp_s;
  return {leg->begin_m + distance, pace, nullptr, 0.0};
}

Posture WalkerScript::posture(double time_s, const BodyShape& shape) const {
  const Progress now = progress(time_s);
  const double step_m = 2.0 * (shape.thigh_m + shape.shin_m) * std::sin(kHipSwing);
  const double phase = kPi * now.distance_m / step_m;
  Posture posture;
  for (std::size_t i = 0; i < 2; ++i) {
    const double own_phase = phase + (i == 0 ? 0.0 : kPi);
    posture.legs[i] = stepping_leg(own_phase, now.pace);
    Posture::Arm& arm = posture.arms[i];
    arm.shoulder_pitch = 3.0 * kDegree - now.pace * 22.0 * kDegree * std::sin(own_phase);
    arm.elbow = (14.0 + now.pace * (10.0 - 10.0 * std::sin(own_phase))) * kDegree;
  }
  const Eigen::Vector2d at = curve_.position(now.distance_m);
  const Eigen::Vector2d along = curve_.direction(now.distance_m, 0.6);
  double yaw = std::atan2(along.y(), along.x());
  if (now.stop != nullptr) yaw += now.stop_weight * angle_between(yaw, now.stop->facing_rad);
  posture.world_from_pelvis = {yawed(yaw), {at.x(), at.y(), standing_pelvis_height(shape, posture.legs)}};
  posture.spine_yaw = -now.pace * 6.0 * kDegree * std::sin(phase);
  posture.head_yaw = 18.0 * kDegree * std::sin(0.8 * time_s + start_s_);
  if (now.stop == nullptr) return posture;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!now.stop->hands_on[i]) continue;
    set_goal(posture.arms[i], *now.stop->hands_on[i], now.stop_weight);
    posture.spine_pitch += 0.12 * now.stop_weight;
  }
  if (now.stop->gesture)
    set_goal(posture.arms[1], talking_hand(posture.world_from_pelvis, time_s), now.stop_weight);
  return posture;
}

StationaryScript::StationaryScript(const Place& place, Random& random)
    : place_(place), phase_(random.uniform(0.0, 2.0 * kPi)), gesture_period_s_(random.uniform(7.0, 11.0)) {}

Posture StationaryScript::posture(double time_s, const BodyShape& shape) const {
  Posture posture;
  const double slow = std::sin(0.5 * time_s + phase_);
  for (Posture::Leg& leg : posture.legs) {
    if (place_.sitting) {
      leg.hip_pitch = 84.0 * kDegree;
      leg.knee = (86.0 + 4.0 * slow) * kDegree;
      leg.hip_roll = 7.0 * kDegree;
    } else {
      leg.hip_pitch = 2.0 * kDegree * slow;
      leg.knee = 4.0 * kDegree;
      leg.hip_roll = 4.0 * kDegree;
    }
  }
  const double height =
      place_.sitting ? kSeatHeight_m + 0.1 * shape.scale : standing_pelvis_height(shape, posture.legs);
  const double sway_m = place_.sitting ? 0.005 : 0.015;
  const Eigen::Matrix3d facing = yawed(place_.facing_rad + 2.0 * kDegree * slow);
  posture.world_from_pelvis = {
      facing, Eigen::Vector3d(place_.at.x(), place_.at.y(), height) + facing.col(1) * sway_m * slow};
  posture.spine_pitch = (6.0 + 4.0 * std::sin(0.37 * time_s + 2.0 * phase_)) * kDegree;
  posture.spine_yaw = 5.0 * kDegree * std::sin(0.61 * time_s + phase_);
  posture.head_yaw = 28.0 * kDegree * std::sin(0.73 * time_s + 3.0 * phase_);
  posture.head_pitch = 6.0 * kDegree + 5.0 * kDegree * slow;
  for (std::size_t i = 0; i < 2; ++i) {
    posture.arms[i].elbow = 40.0 * kDegree;
    if (!place_.hands_on[i]) continue;
    const double beat = 6.0 * time_s + phase_ + 2.0 * static_cast<double>(i);
    const Eigen::Vector3d typing(0.012 * std::sin(0.31 * beat), 0.02 * std::sin(0.23 * beat),
                                 0.006 * std::sin(2.1 * beat));
    set_goal(posture.arms[i], *place_.hands_on[i] + typing, 1.0);
  }
  // Talks for the last third of every period.
  const double part = std::fmod(time_s / gesture_period_s_ + phase_, 1.0);
  const double talk = smooth_step((part - 0.62) / 0.08) * smooth_step((1.0 - part) / 0.08);
  if (talk > 0.0) {
    Posture::Arm& arm = posture.arms[1];
    const Eigen::Vector3d hand = talking_hand(posture.world_from_pelvis, time_s);
    if (arm.goal_weight > 0.0) {
      arm.hand_goal_in_world += talk * (hand - arm.hand_goal_in_world);
    } else {
      set_goal(arm, hand, talk);
    }
  }
  return posture;
}

}  // namespace cpslam::sim
