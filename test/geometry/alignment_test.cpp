#include "geometry/alignment.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "cpslam/error.h"
#include "util/random.h"

namespace cpslam {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points random_points(Random& random, std::size_t count) {
  Points points(count);
  for (Eigen::Vector3d& p : points) p = Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  return points;
}

SE3 random_transform(Random& random) {
  Eigen::Matrix<double, 6, 1> twist;
  for (int i = 0; i < 6; ++i) twist[i] = random.uniform(-3.0, 3.0);
  return SE3::exp(twist);
}

Points moved(const SE3& transform, const Points& points) {
  Points result;
  for (const Eigen::Vector3d& p : points) result.emplace_back(transform * p);
  return result;
}

double squared_error(const SE3& transform, const Points& source, const Points& target) {
  double sum = 0.0;
  for (std::size_t i = 0; i < source.size(); ++i) sum += (target[i] - transform * source[i]).squaredNorm();
  return sum;
}

void expect_rotation(const Eigen::Matrix3d& m) {
  EXPECT_LT((m * m.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-13);
  EXPECT_NEAR(m.determinant(), 1.0, 1e-13);
}

TEST(AlignPoints, RecoversRandomTransforms) {
  Random random(1);
  for (const std::size_t count : {3U, 4U, 10U, 100U}) {
    for (int round = 0; round < 50; ++round) {
      const Points source = random_points(random, count);
      const SE3 transform = random_transform(random);
      const SE3 found = align_points(source, moved(transform, source));
      EXPECT_LT((found.rotation - transform.rotation).norm(), 1e-11) << count;
      EXPECT_LT((found.translation - transform.translation).norm(), 1e-11) << count;
      expect_rotation(found.rotation);
    }
  }
}

TEST(AlignPoints, FarFromTheOrigin) {
  Random random(2);
  Points source = random_points(random, 20);
  for (Eigen::Vector3d& p : source) p += Eigen::Vector3d(1e4, -1e4, 1e4);
  const SE3 transform = random_transform(random);
  EXPECT_LT(squared_error(align_points(source, moved(transform, source)), source, moved(transform, source)),
            1e-18);
}

TEST(AlignPoints, NoNeighbourOfTheAnswerIsBetter) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    const Points source = random_points(random, 12);
    Points target = moved(random_transform(random), source);
    for (Eigen::Vector3d& p : target)
      p += 0.3 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const SE3 found = align_points(source, target);
    const double least = squared_error(found, source, target);
    for (int i = 0; i < 50; ++i) {
      Eigen::Matrix<double, 6, 1> twist;
      for (int k = 0; k < 6; ++k) twist[k] = 1e-3 * random.normal();
      EXPECT_GT(squared_error(SE3::exp(twist) * found, source, target), least);
    }
  }
}

TEST(AlignPoints, NeverAnswersWithAReflection) {
  Random random(4);
  for (int round = 0; round < 50; ++round) {
    const Points source = random_points(random, 8);
    Points target = source;
    for (Eigen::Vector3d& p : target) p.x() = -p.x();
    const SE3 found = align_points(source, target);
    expect_rotation(found.rotation);
    // No worse than any rotation tried at random.
    const double least = squared_error(found, source, target);
    for (int i = 0; i < 50; ++i) {
      SE3 other = random_transform(random);
      other.translation = found.translation;
      EXPECT_GE(squared_error(other, source, target), least - 1e-12);
    }
  }
}

TEST(AlignPoints, PlanarPointsNeedNoReflection) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    Points source = random_points(random, 6);
    for (Eigen::Vector3d& p : source) p.z() = 0.0;
    const SE3 transform = random_transform(random);
    const SE3 found = align_points(source, moved(transform, source));
    expect_rotation(found.rotation);
    EXPECT_LT((found.rotation - transform.rotation).norm(), 1e-10);
  }
}

TEST(AlignPoints, CollinearPointsStillAlign) {
  const Points source = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  const Points target = {{0, 1, 0}, {0, 2, 0}, {0, 4, 0}};
  const SE3 found = align_points(source, target);
  expect_rotation(found.rotation);
  EXPECT_LT(squared_error(found, source, target), 1e-24);
}

TEST(AlignPoints, RefusesTooFewOrUnequalSets) {
  const Points three(3, Eigen::Vector3d::Zero());
  const Points two(2, Eigen::Vector3d::Zero());
  EXPECT_THROW((void)align_points(three, two), InputError);
  EXPECT_THROW((void)align_points(two, two), InputError);
  EXPECT_NO_THROW((void)align_points(three, three));
}

}  // namespace
}  // namespace cpslam
