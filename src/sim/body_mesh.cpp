#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/body.h"

namespace cpslam::sim {
namespace {

constexpr int kSegments = 14;
constexpr int kLimbSegments = 10;

// A tapered limb hanging down from the origin, round at both ends, a little thicker above its middle.
std::vector<Ring> limb(double length, double top_radius, double bottom_radius, double muscle) {
  std::vector<Ring> rings;
  const auto add = [&](double z, double radius) {
    rings.push_back({static_cast<float>(z), static_cast<float>(radius), static_cast<float>(radius)});
  };
  constexpr int kCap = 3;
  for (int i = 0; i < kCap; ++i) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - static_cast<double>(i) / kCap);
    add(-length - bottom_radius * std::sin(angle), bottom_radius * std::cos(angle));
  }
  constexpr int kMiddle = 5;
  for (int i = 0; i <= kMiddle; ++i) {
    const double up = static_cast<double>(i) / kMiddle;
    const double swell = 1.0 + muscle * std::sin(std::numbers::pi * std::pow(up, 0.7));
    add(-length * (1.0 - up), (bottom_radius + up * (top_radius - bottom_radius)) * swell);
  }
  for (int i = kCap - 1; i >= 0; --i) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - static_cast<double>(i) / kCap);
    add(top_radius * std::sin(angle), top_radius * std::cos(angle));
  }
  return rings;
}

std::vector<Ring> ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, int n_rings) {
  std::vector<Ring> rings;
  for (int i = 0; i <= n_rings; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / n_rings - 0.5);
    const double around = std::cos(angle);
    rings.push_back({static_cast<float>(centre.z() + radii.z() * std::sin(angle)),
                     static_cast<float>(radii.x() * around), static_cast<float>(radii.y() * around),
                     static_cast<float>(centre.x()), static_cast<float>(centre.y())});
  }
  return rings;
}

std::vector<Ring> scaled(std::vector<Ring> rings, double length, double girth) {
  const auto l = static_cast<float>(length);
  const auto g = static_cast<float>(length * girth);
  for (Ring& ring : rings) ring = {ring.z * l, ring.radius_x * g, ring.radius_y * g, ring.x * l, ring.y * l};
  return rings;
}

void add_part(std::vector<BodyPart>& parts, BodyPart::Frame frame, const std::vector<Ring>& rings,
              int n_segments, int material) {
  BodyPart part;
  part.frame = frame;
  add_lathe(part.mesh, SE3(), rings, n_segments, material);
  parts.push_back(std::move(part));
}

void add_bone(std::vector<BodyPart>& parts, std::size_t from, std::size_t to, const std::vector<Ring>& rings,
              int material) {
  add_part(parts, BodyPart::Frame::kBone, rings, kLimbSegments, material);
  parts.back().from = static_cast<Joint>(from);
  parts.back().to = static_cast<Joint>(to);
}

void add_limbs(std::vector<BodyPart>& parts, const BodyShape& shape, const Clothes& clothes) {
  const double g = shape.scale * shape.girth;
  for (std::size_t i = 0; i < 2; ++i) {
    add_bone(parts, kHipLeft + i, kKneeLeft + i, limb(shape.thigh_m, 0.085 * g, 0.058 * g, 0.05),
             clothes.trousers);
    add_bone(parts, kKneeLeft + i, kAnkleLeft + i, limb(shape.shin_m, 0.058 * g, 0.046 * g, 0.14),
             clothes.trousers);
    std::vector<Ring> shoe = ellipsoid({0, 0, -0.4 * shape.foot_m},
                                       {0.045 * shape.scale, 0.047 * shape.scale, 0.8 * shape.foot_m}, 8);
    add_bone(parts, kAnkleLeft + i, kToesLeft + i, shoe, clothes.shoes);
    parts.back().foot = true;
    add_bone(parts, kShoulderLeft + i, kElbowLeft + i, limb(shape.upper_arm_m, 0.056 * g, 0.042 * g, 0.06),
             clothes.shirt);
    const int sleeve = clothes.long_sleeves ? clothes.shirt : clothes.skin;
    add_bone(parts, kElbowLeft + i, kWristLeft + i, limb(shape.forearm_m, 0.041 * g, 0.03 * g, 0.08), sleeve);
    add_bone(parts, kWristLeft + i, kFingersLeft + i,
             ellipsoid({0, 0, -0.5 * shape.hand_m},
                       {0.022 * shape.scale, 0.042 * shape.scale, 0.58 * shape.hand_m}, 7),
             clothes.skin);
  }
}

}  // namespace

std::vector<BodyPart> make_body(const BodyShape& shape, const Clothes& clothes) {
  using Frame = BodyPart::Frame;
  std::vector<BodyPart> parts;
  const std::vector<Ring> pelvis{
      {-0.13F, 0, 0},         {-0.12F, 0.06F, 0.08F}, {-0.07F, 0.10F, 0.15F}, {0.02F, 0.118F, 0.172F},
      {0.10F, 0.112F, 0.16F}, {0.14F, 0.10F, 0.14F},  {0.14F, 0, 0}};
  const std::vector<Ring> torso{{0.03F, 0, 0},           {0.03F, 0.112F, 0.166F},
                                {0.12F, 0.114F, 0.162F}, {0.22F, 0.110F, 0.152F},
                                {0.34F, 0.122F, 0.172F}, {0.42F, 0.116F, 0.19F},
                                {0.48F, 0.094F, 0.175F}, {0.52F, 0.07F, 0.12F},
                                {0.545F, 0.05F, 0.06F},  {0.55F, 0, 0}};
  const std::vector<Ring> neck{{-0.06F, 0, 0, 0.0F},
                               {-0.06F, 0.055F, 0.055F, 0.0F},
                               {0.08F, 0.052F, 0.052F, 0.01F},
                               {0.1F, 0, 0, 0.01F}};
  add_part(parts, Frame::kPelvis, scaled(pelvis, shape.scale, shape.girth), kSegments, clothes.trousers);
  add_part(parts, Frame::kTorso, scaled(torso, shape.scale, shape.girth), kSegments, clothes.shirt);
  add_part(parts, Frame::kHead, scaled(neck, shape.scale, 1.0), kSegments, clothes.skin);
  add_part(parts, Frame::kHead, scaled(ellipsoid({0.02, 0, 0.18}, {0.1, 0.078, 0.13}, 12), shape.scale, 1.0),
           kSegments, clothes.head);
  add_part(parts, Frame::kHead,
           scaled(ellipsoid({0.118, 0, 0.165}, {0.02, 0.014, 0.026}, 4), shape.scale, 1.0), 6, clothes.skin);
  add_limbs(parts, shape, clothes);
  return parts;
}

SE3 part_pose(const BodyPart& part, const Skeleton& skeleton) {
  switch (part.frame) {
    case BodyPart::Frame::kPelvis:
      return skeleton.world_from_pelvis;
    case BodyPart::Frame::kTorso:
      return skeleton.world_from_torso;
    case BodyPart::Frame::kHead:
      return skeleton.world_from_head;
    case BodyPart::Frame::kBone:
      break;
  }
  const Eigen::Vector3d start = skeleton.joints[part.from];
  const Eigen::Vector3d z = (start - skeleton.joints[part.to]).normalized();
  const Eigen::Vector3d forward = skeleton.world_from_pelvis.rotation.col(0);
  // The part's x looks forward, a foot's up; bones along that direction take the other.
  Eigen::Vector3d hint = part.foot ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : forward;
  if (std::abs(hint.dot(z)) > 0.9) hint = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d rotation;
  const Eigen::Vector3d x = (hint - hint.dot(z) * z).normalized();
  rotation << x, z.cross(x), z;
  return {rotation, start};
}

}  // namespace cpslam::sim
