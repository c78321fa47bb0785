#include "optim/pose_equations.h"

#include <array>
#include <cmath>

#include "optim/reprojection.h"

namespace cpslam {
namespace {

/// Observations are summed in this many independent lanes: two SSE registers, one of AVX.
constexpr std::size_t kLanes = 4;
constexpr double kNoKernel = 1e300;
/// Beyond this a pixel, a metre or 1 / sigma is a mistake, and squares of it could overflow.
constexpr double kMaxMagnitude = 1e7;

bool sensible(double value) { return std::abs(value) < kMaxMagnitude; }  // false for NaN

bool sensible(const PoseObservation& observation) {
  const PointObservation& seen = observation.seen;
  const Eigen::Vector3d& point = observation.point_in_world;
  const bool pixel = sensible(point.x()) && sensible(point.y()) && sensible(point.z()) &&
                     sensible(seen.uv.x()) && sensible(seen.uv.y()) && seen.sigma_px > 1.0 / kMaxMagnitude;
  return pixel && !std::isnan(seen.right) &&
         (!seen.has_depth() || (sensible(seen.right) && seen.sigma_right_px > 1.0 / kMaxMagnitude));
}

/// The sums, one row per number: upper triangle of the information (its structural zero left out), gradient, cost.
enum Sum : std::size_t {
  k00, k02, k03, k04, k05, k11, k12, k13, k14, k15, k22, k23, k24, k25, k33, k34, k35, k44, k45, k55,  //
  kG0, kG1, kG2, kG3, kG4, kG5, kCost, kNumSums
};
using Sums = std::array<std::array<double, kLanes>, kNumSums>;

PoseModel collect(const Sums& sums) {
  std::array<double, kNumSums> s{};
  for (std::size_t i = 0; i < kNumSums; ++i) {
    for (const double lane : sums[i]) s[i] += lane;
  }
  PoseModel model;
  model.information << s[k00], 0.0, s[k02], s[k03], s[k04], s[k05],  //
      0.0, s[k11], s[k12], s[k13], s[k14], s[k15],                    //
      s[k02], s[k12], s[k22], s[k23], s[k24], s[k25],                 //
      s[k03], s[k13], s[k23], s[k33], s[k34], s[k35],                 //
      s[k04], s[k14], s[k24], s[k34], s[k44], s[k45],                 //
      s[k05], s[k15], s[k25], s[k35], s[k45], s[k55];
  model.gradient << s[kG0], s[kG1], s[kG2], s[kG3], s[kG4], s[kG5];
  model.cost = s[kCost];
  return model;
}

}  // namespace

PoseEquations::PoseEquations(const ReprojectionCamera& camera, std::span<const PoseObservation> observations)
    : camera_(camera), n_(observations.size()) {
  const std::size_t padded = (n_ + kLanes - 1) / kLanes * kLanes;
  for (auto* array :
       {&x_, &y_, &z_, &u_, &v_, &disparity_, &per_sigma_, &per_sigma_depth_, &gate_, &active_}) {
    array->resize(padded);
  }
  valid_.resize(n_);
  for (std::size_t i = 0; i < n_; ++i) {
    const PointObservation& seen = observations[i].seen;
    valid_[i] = sensible(observations[i]) ? 1 : 0;
    if (valid_[i] == 0) continue;
    x_[i] = observations[i].point_in_world.x();
    y_[i] = observations[i].point_in_world.y();
    z_[i] = observations[i].point_in_world.z();
    u_[i] = seen.uv.x() - camera.cx;
    v_[i] = seen.uv.y() - camera.cy;
    per_sigma_[i] = 1.0 / seen.sigma_px;
    disparity_[i] = seen.has_depth() ? seen.uv.x() - seen.right : 0.0;
    per_sigma_depth_[i] = seen.has_depth() ? 1.0 / seen.sigma_right_px : 0.0;
    gate_[i] = chi2_gate(seen);
  }
}

PoseModel PoseEquations::linearize(const SE3& cam_from_world, bool robust) const {
  const Eigen::Matrix3d& r = cam_from_world.rotation;
  const Eigen::Vector3d& t = cam_from_world.translation;
  const double r00 = r(0, 0), r01 = r(0, 1), r02 = r(0, 2), t0 = t(0);
  const double r10 = r(1, 0), r11 = r(1, 1), r12 = r(1, 2), t1 = t(1);
  const double r20 = r(2, 0), r21 = r(2, 1), r22 = r(2, 2), t2 = t(2);
  const double fx = camera_.fx, fy = camera_.fy, bf = camera_.bf;
  const double no_kernel = robust ? 0.0 : kNoKernel;

  Sums sums{};
  for (std::size_t start = 0; start < active_.size(); start += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = start + lane;
      const double x = r00 * x_[i] + r01 * y_[i] + r02 * z_[i] + t0;
      const double y = r10 * x_[i] + r11 * y_[i] + r12 * z_[i] + t1;
      const double z = r20 * x_[i] + r21 * y_[i] + r22 * z_[i] + t2;
      const auto [inverse, slope] = inverse_depth(z);

      // Rows of the Jacobian (reprojection_jacobian, then p x row for the rotation), their zeros left out:
      //   u: gu * [inverse, 0, -x slope, -xy slope, z inverse + x^2 slope, -y inverse]
      //   v: gv * [0, inverse, -y slope, -z inverse - y^2 slope, xy slope, x inverse]
      //   disparity: gd * [0, 0, slope, y slope, -x slope, 0]
      const double gu = -fx * per_sigma_[i], gv = -fy * per_sigma_[i], gd = bf * per_sigma_depth_[i];
      const double eu = u_[i] * per_sigma_[i] + gu * x * inverse;
      const double ev = v_[i] * per_sigma_[i] + gv * y * inverse;
      const double ed = disparity_[i] * per_sigma_depth_[i] - gd * inverse;
      const double x_slope = x * slope, y_slope = y * slope, xy_slope = x * y_slope, z_inverse = z * inverse;
      const double u0 = gu * inverse, u2 = -gu * x_slope, u3 = -gu * xy_slope;
      const double u4 = gu * (z_inverse + x * x_slope), u5 = -u0 * y;
      const double v1 = gv * inverse, v2 = -gv * y_slope, v3 = -gv * (z_inverse + y * y_slope);
      const double v4 = gv * xy_slope, v5 = v1 * x;
      const double d2 = gd * slope, d3 = gd * y_slope, d4 = -gd * x_slope;

      const double chi2 = eu * eu + ev * ev + ed * ed;
      const double gate = gate_[i] + no_kernel;
      const bool linear = chi2 > gate;
      const double weight = linear ? std::sqrt(gate / chi2) : 1.0;
      const double w = active_[i] * weight;
      const auto add = [&sums, lane](Sum sum, double value) { sums[sum][lane] += value; };
      add(kCost, active_[i] * (linear ? 2.0 * chi2 * weight - gate : chi2));

      const double wu0 = w * u0, wu2 = w * u2, wu3 = w * u3, wu4 = w * u4, wu5 = w * u5;
      const double wv1 = w * v1, wv2 = w * v2, wv3 = w * v3, wv4 = w * v4, wv5 = w * v5;
      const double wd2 = w * d2, wd3 = w * d3, wd4 = w * d4;
      add(k00, wu0 * u0);
      add(k02, wu0 * u2);
      add(k03, wu0 * u3);
      add(k04, wu0 * u4);
      add(k05, wu0 * u5);
      add(k11, wv1 * v1);
      add(k12, wv1 * v2);
      add(k13, wv1 * v3);
      add(k14, wv1 * v4);
      add(k15, wv1 * v5);
      add(k22, wu2 * u2 + wv2 * v2 + wd2 * d2);
      add(k23, wu2 * u3 + wv2 * v3 + wd2 * d3);
      add(k24, wu2 * u4 + wv2 * v4 + wd2 * d4);
      add(k25, wu2 * u5 + wv2 * v5);
      add(k33, wu3 * u3 + wv3 * v3 + wd3 * d3);
      add(k34, wu3 * u4 + wv3 * v4 + wd3 * d4);
      add(k35, wu3 * u5 + wv3 * v5);
      add(k44, wu4 * u4 + wv4 * v4 + wd4 * d4);
      add(k45, wu4 * u5 + wv4 * v5);
      add(k55, wu5 * u5 + wv5 * v5);
      add(kG0, wu0 * eu);
      add(kG1, wv1 * ev);
      add(kG2, wu2 * eu + wv2 * ev + wd2 * ed);
      add(kG3, wu3 * eu + wv3 * ev + wd3 * ed);
      add(kG4, wu4 * eu + wv4 * ev + wd4 * ed);
      add(kG5, wu5 * eu + wv5 * ev);
    }
  }
  return collect(sums);
}

PoseEquations::Selection PoseEquations::select(const SE3& cam_from_world, bool gated) {
  Selection selection;
  for (std::size_t i = 0; i < n_; ++i) {
    const Eigen::Vector3d p = cam_from_world * Eigen::Vector3d(x_[i], y_[i], z_[i]);
    const double inverse = inverse_depth(p.z()).value;
    const double eu = (u_[i] - camera_.fx * p.x() * inverse) * per_sigma_[i];
    const double ev = (v_[i] - camera_.fy * p.y() * inverse) * per_sigma_[i];
    const double ed = (disparity_[i] - camera_.bf * inverse) * per_sigma_depth_[i];
    const double chi2 = eu * eu + ev * ev + ed * ed;
    const bool chosen = valid_[i] != 0 && p.z() > kMinDepthM && (!gated || chi2 <= gate_[i]);
    selection.changed = selection.changed || chosen != active(i);
    active_[i] = chosen ? 1.0 : 0.0;
    if (!chosen) continue;
    ++selection.n_active;
    selection.chi2 += chi2;
  }
  return selection;
}

}  // namespace cpslam
