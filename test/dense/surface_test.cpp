#include "dense/surface.h"

#include <gtest/gtest.h>

#include "dense/flat_scene.h"
#include "support/tum_cameras.h"

namespace cpslam {
namespace {

TEST(Surface, PointsLieOnAPlaneWithItsNormalWhateverSlopeAndLens) {
  for (const CameraSettings& settings : {synthetic::settings().camera, tum1_camera()}) {
    const PinholeCamera pinhole(settings);
    const DenseCamera camera(pinhole);
    for (const double slope : {-1.5, -0.5, 0.0, 0.7}) {
      const Eigen::Vector3d normal = Eigen::Vector3d(slope, 0.3, 1.0).normalized();
      const DenseView view = make_dense_view(camera, flat::look(pinhole, {{normal, 2.0 * normal.z()}}));
      const std::vector<SurfacePoint> points = surface_points(camera, view, 13.0F);
      ASSERT_GT(points.size(), 50'000U) << slope;
      for (const SurfacePoint& point : points) {
        ASSERT_NEAR(normal.dot(point.position_m.cast<double>()), 2.0 * normal.z(), 0.002);
        ASSERT_LT((point.normal.cast<double>() + normal).norm(), 0.03) << "towards the camera";
      }
    }
  }
}

TEST(Surface, NoiseIsEvenedOut) {
  const PinholeCamera pinhole = flat::camera();
  const DenseCamera camera(pinhole);
  Random random(1);
  DenseFrame frame = flat::look(pinhole, {flat::wall(2.0)});
  flat::disturb(0.008, random, frame);
  const std::vector<SurfacePoint> points = surface_points(camera, make_dense_view(camera, frame), 13.0F);
  double squares = 0.0;
  for (const SurfacePoint& point : points) squares += std::pow(point.position_m.z() - 2.0, 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(points.size())), 0.004);
}

TEST(Surface, RimsAndFarSurfacesGiveNone) {
  const PinholeCamera pinhole = flat::camera();
  const DenseCamera camera(pinhole);
  const DenseView view = make_dense_view(
      camera, flat::look(pinhole, {flat::wall(4.5), flat::board(1.5, 0.3), flat::board(3.0, 1.0)}));
  std::size_t n_near = 0, n_middle = 0;
  for (const SurfacePoint& point : surface_points(camera, view, 4.0F)) {
    const bool near = std::abs(point.position_m.z() - 1.5F) < 0.005F;
    ASSERT_TRUE(near || std::abs(point.position_m.z() - 3.0F) < 0.005F) << point.position_m.z();
    ++(near ? n_near : n_middle);
  }
  EXPECT_GT(n_near, 9'000U);
  EXPECT_GT(n_middle, 18'000U);
}

TEST(Surface, NearSurfacesWeighMore) {
  const PinholeCamera pinhole = flat::camera();
  const DenseCamera camera(pinhole);
  const auto middle_weight = [&](double z_m) {
    const DenseView view = make_dense_view(camera, flat::look(pinhole, {flat::wall(z_m)}));
    const std::vector<SurfacePoint> points = surface_points(camera, view, 13.0F);
    return points.at(points.size() / 2).weight;
  };
  EXPECT_NEAR(middle_weight(1.0), 1.0F, 0.15F);
  EXPECT_GT(middle_weight(1.0), 3.0F * middle_weight(2.0));
}

}  // namespace
}  // namespace cpslam
