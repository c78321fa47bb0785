#include "sim/body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cpslam::sim {
namespace {

constexpr double kHipHalfWidth_m = 0.09;
constexpr double kShoulderHalfWidth_m = 0.19;
constexpr double kShoulderHeight_m = 0.46;
constexpr double kNeckHeight_m = 0.52;
constexpr double kSoleUnderToes_m = 0.04;

Eigen::Matrix3d turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// Direction of a limb that hangs down, lifted forward and outward (side: +1 left, -1 right).
Eigen::Vector3d limb_direction(double pitch, double roll, double side) {
  return Eigen::Vector3d(std::sin(pitch) * std::cos(roll), side * std::sin(roll),
                         -std::cos(pitch) * std::cos(roll))
      .normalized();
}

struct LegJoints {
  Eigen::Vector3d knee, ankle, toes;  // from the hip, pelvis frame
};

LegJoints pose_leg(const BodyShape& shape, const Posture::Leg& leg, double side) {
  LegJoints joints;
  joints.knee = shape.thigh_m * limb_direction(leg.hip_pitch, leg.hip_roll, side);
  joints.ankle =
      joints.knee + shape.shin_m * limb_direction(leg.hip_pitch - leg.knee, 0.3 * leg.hip_roll, side);
  joints.toes =
      joints.ankle +
      shape.foot_m * Eigen::Vector3d(std::cos(leg.foot_pitch), 0.15 * side, std::sin(leg.foot_pitch)) -
      Eigen::Vector3d(0, 0, shape.ankle_height_m - kSoleUnderToes_m);
  return joints;
}

// Elbow of an arm from shoulder to wrist; it falls towards the hint.
Eigen::Vector3d bend_elbow(const Eigen::Vector3d& shoulder, const Eigen::Vector3d& wrist, double upper_m,
                           double fore_m, const Eigen::Vector3d& hint) {
  const Eigen::Vector3d along = wrist - shoulder;
  const double distance = along.norm();
  const Eigen::Vector3d axis = along / distance;
  const double reach = (upper_m * upper_m - fore_m * fore_m + distance * distance) / (2.0 * distance);
  const double height = std::sqrt(std::max(0.0, upper_m * upper_m - reach * reach));
  const Eigen::Vector3d aside = (hint - hint.dot(axis) * axis).normalized();
  return shoulder + reach * axis + height * aside;
}

void pose_arm(const BodyShape& shape, const Posture::Arm& arm, std::size_t side_index, Skeleton& skeleton) {
  const double side = side_index == 0 ? 1.0 : -1.0;
  const SE3& torso = skeleton.world_from_torso;
  const Eigen::Vector3d shoulder =
      torso * (shape.scale * Eigen::Vector3d(0, side * kShoulderHalfWidth_m, kShoulderHeight_m));
  const Eigen::Vector3d hanging_elbow =
      shoulder +
      torso.rotation * (shape.upper_arm_m * limb_direction(arm.shoulder_pitch, arm.shoulder_roll, side));
  const Eigen::Vector3d hanging_wrist =
      hanging_elbow + torso.rotation * (shape.forearm_m * limb_direction(arm.shoulder_pitch + arm.elbow,
                                                                         0.4 * arm.shoulder_roll, side));
  Eigen::Vector3d wrist = hanging_wrist + arm.goal_weight * (arm.hand_goal_in_world - hanging_wrist);
  const double longest = 0.98 * (shape.upper_arm_m + shape.forearm_m);
  const double shortest = 0.15;
  const Eigen::Vector3d reach = wrist - shoulder;
  wrist = shoulder + reach.normalized() * std::clamp(reach.norm(), shortest, longest);
  const Eigen::Vector3d hint = torso.rotation * Eigen::Vector3d(-0.6, 0.5 * side, -0.6);
  const Eigen::Vector3d elbow = bend_elbow(shoulder, wrist, shape.upper_arm_m, shape.forearm_m, hint);
  // Hands follow the forearm, and lie flatter on what they touch.
  Eigen::Vector3d pointing = (wrist - elbow).normalized();
  pointing.z() *= 1.0 - 0.8 * arm.goal_weight;
  skeleton.joints[kShoulderLeft + side_index] = shoulder;
  skeleton.joints[kElbowLeft + side_index] = elbow;
  skeleton.joints[kWristLeft + side_index] = wrist;
  skeleton.joints[kFingersLeft + side_index] = wrist + shape.hand_m * pointing.normalized();
}

}  // namespace

BodyShape BodyShape::random(Random& random) {
  BodyShape shape;
  shape.scale = random.uniform(0.92, 1.06);
  shape.girth = random.uniform(0.92, 1.15);
  for (double* length : {&shape.thigh_m, &shape.shin_m, &shape.foot_m, &shape.ankle_height_m,
                         &shape.upper_arm_m, &shape.forearm_m, &shape.hand_m})
    *length *= shape.scale;
  return shape;
}

Skeleton pose_skeleton(const BodyShape& shape, const Posture& posture) {
  Skeleton skeleton;
  skeleton.world_from_pelvis = posture.world_from_pelvis;
  skeleton.world_from_torso =
      posture.world_from_pelvis * SE3(turn(posture.spine_yaw, Eigen::Vector3d::UnitZ()) *
                                          turn(posture.spine_pitch, Eigen::Vector3d::UnitY()),
                                      Eigen::Vector3d::Zero());
  const Eigen::Vector3d neck(0.01 * shape.scale, 0.0, kNeckHeight_m * shape.scale);
  skeleton.world_from_head =
      skeleton.world_from_torso * SE3(turn(posture.head_yaw, Eigen::Vector3d::UnitZ()) *
                                          turn(posture.head_pitch, Eigen::Vector3d::UnitY()),
                                      neck);
  skeleton.joints[kNeck] = skeleton.world_from_torso * neck;
  skeleton.joints[kHead] = skeleton.world_from_head * (shape.scale * Eigen::Vector3d(0.02, 0, 0.18));
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    const LegJoints leg = pose_leg(shape, posture.legs[i], side);
    const Eigen::Vector3d hip(0, side * kHipHalfWidth_m * shape.scale, 0);
    skeleton.joints[kHipLeft + i] = posture.world_from_pelvis * hip;
    skeleton.joints[kKneeLeft + i] = posture.world_from_pelvis * (hip + leg.knee);
    skeleton.joints[kAnkleLeft + i] = posture.world_from_pelvis * (hip + leg.ankle);
    skeleton.joints[kToesLeft + i] = posture.world_from_pelvis * (hip + leg.toes);
    pose_arm(shape, posture.arms[i], i, skeleton);
  }
  return skeleton;
}

double standing_pelvis_height(const BodyShape& shape, const std::array<Posture::Leg, 2>& legs) {
  double lowest = 0.0;
  for (const Posture::Leg& leg : legs) {
    const LegJoints joints = pose_leg(shape, leg, 1.0);
    lowest = std::min({lowest, joints.ankle.z() - shape.ankle_height_m, joints.toes.z() - kSoleUnderToes_m});
  }
  return -lowest;
}

}  // namespace cpslam::sim
