#include <gtest/gtest.h>

#include "slam/point_snapshot.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

/// A point 2 m ahead that was seen head on from the origin at octave 2.
class ExpectPoint : public testing::Test {
 protected:
  ExpectPoint() {
    point.position_in_world = {0.0, 0.0, 2.0};
    point.normal = {0.0, 0.0, 1.0};
    point.max_distance_m = static_cast<float>(2.0 * std::pow(1.2, 2));
    point.min_distance_m = static_cast<float>(2.0 / std::pow(1.2, 5));
  }
  [[nodiscard]] std::optional<ProjectionQuery> from(const SE3& cam_from_world) const {
    return expect_point(kRig, snapshot(), cam_from_world, cam_from_world.inverse().translation, {3.0F, 5.0F});
  }
  [[nodiscard]] PointSnapshot snapshot() const { return {MapPointId{}, point}; }
  /// A camera at `distance_m` from the point, `angle_rad` to its side, that looks at it.
  static SE3 around(double distance_m, double angle_rad) {
    const SE3 world_from_cam(so3_exp({0.0, angle_rad, 0.0}),
                             Eigen::Vector3d(0.0, 0.0, 2.0) -
                                 so3_exp({0.0, angle_rad, 0.0}) * Eigen::Vector3d(0.0, 0.0, distance_m));
    return world_from_cam.inverse();
  }
  MapPoint point;
};

TEST_F(ExpectPoint, SeesItWhereItWas) {
  const PointSnapshot source = snapshot();
  const auto query = expect_point(kRig, source, {}, {0.0, 0.0, 0.0}, {3.0F, 5.0F});
  ASSERT_TRUE(query.has_value());
  EXPECT_FLOAT_EQ(query->uv.x(), 319.5F);
  EXPECT_FLOAT_EQ(query->uv.y(), 239.5F);
  EXPECT_FLOAT_EQ(query->disparity, 20.0F);
  EXPECT_NEAR(query->radius, 3.0 * 1.44, 1e-5) << "frontal window at octave 2";
  EXPECT_EQ(query->min_octave, 1);
  EXPECT_EQ(query->max_octave, 3);
  EXPECT_EQ(query->descriptor, &source.descriptor);
}

TEST_F(ExpectPoint, WindowIsWiderFromTheSide) {
  const auto query = from(around(2.0, 0.3));
  ASSERT_TRUE(query.has_value());
  EXPECT_NEAR(query->radius, 5.0 * 1.44, 1e-5);
}

TEST_F(ExpectPoint, NothingBehindTheCamera) {
  EXPECT_FALSE(from(synthetic::moved({}, {0.0, 0.0, 4.0})).has_value());
}

TEST_F(ExpectPoint, NothingOutsideTheImage) {
  // 319.5 px at 525 px focal length: 1.217 m to the left at 2 m.
  EXPECT_TRUE(from(synthetic::moved({}, {1.2, 0.0, 0.0})).has_value());
  EXPECT_FALSE(from(synthetic::moved({}, {1.3, 0.0, 0.0})).has_value());
  EXPECT_FALSE(from(synthetic::moved({}, {0.0, -1.0, 0.0})).has_value());
}

TEST_F(ExpectPoint, NothingTooNearOrTooFarForThePyramid) {
  const double nearest_m = 0.8 * 2.0 / std::pow(1.2, 5);
  const double farthest_m = 1.2 * 2.0 * 1.44;
  EXPECT_TRUE(from(around(1.01 * nearest_m, 0.0)).has_value());
  EXPECT_FALSE(from(around(0.99 * nearest_m, 0.0)).has_value());
  EXPECT_TRUE(from(around(0.99 * farthest_m, 0.0)).has_value());
  EXPECT_FALSE(from(around(1.01 * farthest_m, 0.0)).has_value());
}

TEST_F(ExpectPoint, NothingFromMoreThanSixtyDegreesOffTheNormal) {
  constexpr double kDegree = 3.14159265358979 / 180.0;
  EXPECT_TRUE(from(around(2.0, 59.0 * kDegree)).has_value());
  EXPECT_FALSE(from(around(2.0, 61.0 * kDegree)).has_value());
  EXPECT_FALSE(from(around(2.0, -61.0 * kDegree)).has_value());
  EXPECT_FALSE(from(around(2.0, 180.0 * kDegree)).has_value());
}

}  // namespace
}  // namespace cpslam
