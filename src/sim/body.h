#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/se3.h"
#include "sim/mesh.h"
#include "util/random.h"

namespace cpslam::sim {

enum Joint : std::size_t {
  kHipLeft,
  kHipRight,
  kKneeLeft,
  kKneeRight,
  kAnkleLeft,
  kAnkleRight,
  kToesLeft,
  kToesRight,
  kShoulderLeft,
  kShoulderRight,
  kElbowLeft,
  kElbowRight,
  kWristLeft,
  kWristRight,
  kFingersLeft,
  kFingersRight,
  kNeck,
  kHead,
  kJointCount
};
using Joints = std::array<Eigen::Vector3d, kJointCount>;

/// Measures of a grown-up body, metres.
struct BodyShape {
  double scale = 1.0;  ///< 1: 1.77 m tall
  double girth = 1.0;
  double thigh_m = 0.44, shin_m = 0.43, foot_m = 0.2, ankle_height_m = 0.07;
  double upper_arm_m = 0.3, forearm_m = 0.26, hand_m = 0.16;

  [[nodiscard]] static BodyShape random(Random& random);
};

/// Angles in rad, 0: upright with hanging limbs; forward is positive.
struct Posture {
  struct Leg {
    double hip_pitch = 0.0, hip_roll = 0.0, knee = 0.0;
    double foot_pitch = 0.0;  ///< against the floor
  };
  struct Arm {
    double shoulder_pitch = 0.05, shoulder_roll = 0.12, elbow = 0.25;
    Eigen::Vector3d hand_goal_in_world = Eigen::Vector3d::Zero();
    double goal_weight = 0.0;  ///< 0: by angles; 1: wrist at the goal
  };
  SE3 world_from_pelvis;  ///< x forward, y left, z up; between the hip joints
  double spine_pitch = 0.05, spine_yaw = 0.0;
  double head_pitch = 0.0, head_yaw = 0.0;
  std::array<Leg, 2> legs;  ///< left, right
  std::array<Arm, 2> arms;
};

/// Where everything is in one posture.
struct Skeleton {
  Joints joints;
  SE3 world_from_pelvis, world_from_torso, world_from_head;
};

[[nodiscard]] Skeleton pose_skeleton(const BodyShape& shape, const Posture& posture);

/// Height of the pelvis above the floor at which the lower foot stands on it.
[[nodiscard]] double standing_pelvis_height(const BodyShape& shape, const std::array<Posture::Leg, 2>& legs);

/// What a body wears.
struct Clothes {
  int shirt = 0, trousers = 0, shoes = 0, skin = 0, head = 0;
  bool long_sleeves = true;
};

/// A rigid piece of the body in its own frame.
struct BodyPart {
  enum class Frame { kPelvis, kTorso, kHead, kBone };
  Frame frame = Frame::kBone;
  Joint from = kHipLeft, to = kHipLeft;  ///< of a bone: its frame has -z from one to the other
  bool foot = false;                     ///< a bone with its sole down
  Mesh mesh;
};

[[nodiscard]] std::vector<BodyPart> make_body(const BodyShape& shape, const Clothes& clothes);

/// World frame of a part.
[[nodiscard]] SE3 part_pose(const BodyPart& part, const Skeleton& skeleton);

}  // namespace cpslam::sim
