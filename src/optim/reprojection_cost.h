#pragma once

#include "ceres/sized_cost_function.h"
#include "optim/observation.h"
#include "optim/pose_manifold.h"

namespace cpslam {

/// Whitened reprojection error of one observation, analytic Jacobians. Two rows: monocular; three: with
/// depth. Parameter blocks: a pose of PoseManifold (lifted Jacobian) and a point in the world (m). Keeps
/// references to the camera and the observation: both must outlive it.
template <int kRows>
class ReprojectionCost final : public ceres::SizedCostFunction<kRows, PoseManifold::kAmbient, 3> {
 public:
  ReprojectionCost(const ReprojectionCamera& camera, const PointObservation& seen)
      : camera_(camera), seen_(seen) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const ReprojectionCamera& camera_;
  const PointObservation& seen_;
};

extern template class ReprojectionCost<2>;
extern template class ReprojectionCost<3>;
using MonoCost = ReprojectionCost<2>;
using DepthCost = ReprojectionCost<3>;

}  // namespace cpslam
