#include "geometry/alignment.h"

#include <Eigen/SVD>

#include "cpslam/error.h"

namespace cpslam {

SE3 align_points(std::span<const Eigen::Vector3d> source, std::span<const Eigen::Vector3d> target) {
  if (source.size() != target.size()) throw InputError("align_points: the point sets differ in size");
  if (source.size() < 3) throw InputError("align_points: at least three point pairs are needed");
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    source_mean += source[i];
    target_mean += target[i];
  }
  source_mean /= static_cast<double>(source.size());
  target_mean /= static_cast<double>(target.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    covariance += (target[i] - target_mean) * (source[i] - source_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  // A reflection would fit better than any rotation: flip the least certain axis instead.
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  return {rotation, target_mean - rotation * source_mean};
}

}  // namespace cpslam
