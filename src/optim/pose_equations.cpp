#include "optim/pose_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optim/reprojection.h"
#include "util/median.h"

namespace cpslam {
namespace {

/// Beyond this a pixel, a metre or 1 / sigma is a mistake, and squares of it could overflow.
constexpr double kMaxMagnitude = 1e7;

bool sensible(double value) {
  return std::abs(value) < kMaxMagnitude;
}  // false for NaN

bool sensible(const PoseObservation& observation) {
  const PointObservation& seen = observation.seen;
  const Eigen::Vector3d& point = observation.point_in_world;
  const bool pixel = sensible(point.x()) && sensible(point.y()) && sensible(point.z()) &&
                     sensible(seen.uv.x()) && sensible(seen.uv.y()) && seen.sigma_px > 1.0 / kMaxMagnitude;
  return pixel && !std::isnan(seen.disparity) &&
         (!seen.has_depth() || (sensible(seen.disparity) && seen.sigma_disparity_px > 1.0 / kMaxMagnitude));
}

/// As long as most observations are right, the median tells how far the residuals of a pose that has not
/// settled yet are blown up. 3 leaves the gate as it is when the residuals are what the sigmas promise.
double relaxed_limit(std::vector<double> chi2_per_gate) {
  const double middle = median(chi2_per_gate);
  return std::isfinite(middle) ? 3.0 * middle : 1.0;
}

}  // namespace

/// The upper triangle of the information (its structural zero left out), the gradient, the cost.
struct PoseEquations::Sums {
  Two h00{}, h02{}, h03{}, h04{}, h05{}, h11{}, h12{}, h13{}, h14{}, h15{};
  Two h22{}, h23{}, h24{}, h25{}, h33{}, h34{}, h35{}, h44{}, h45{}, h55{};
  Two g0{}, g1{}, g2{}, g3{}, g4{}, g5{};
  Two cost{};

  [[nodiscard]] PoseModel collect() const {
    const auto sum = [](const Two& two) { return two[0] + two[1]; };
    Eigen::Matrix<double, 6, 6> upper = Eigen::Matrix<double, 6, 6>::Zero();
    upper.row(0) << sum(h00), 0.0, sum(h02), sum(h03), sum(h04), sum(h05);
    upper.row(1).tail<5>() << sum(h11), sum(h12), sum(h13), sum(h14), sum(h15);
    upper.row(2).tail<4>() << sum(h22), sum(h23), sum(h24), sum(h25);
    upper.row(3).tail<3>() << sum(h33), sum(h34), sum(h35);
    upper.row(4).tail<2>() << sum(h44), sum(h45);
    upper(5, 5) = sum(h55);
    PoseModel model;
    model.information = upper.selfadjointView<Eigen::Upper>();
    model.gradient << sum(g0), sum(g1), sum(g2), sum(g3), sum(g4), sum(g5);
    model.cost = sum(cost);
    return model;
  }
};

PoseEquations::PoseEquations(const ReprojectionCamera& camera, std::span<const PoseObservation> observations)
    : camera_(camera), pairs_((observations.size() + 1) / 2), valid_(observations.size()) {
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const auto& [point, seen] = observations[i];
    valid_[i] = sensible(observations[i]) ? 1 : 0;
    if (valid_[i] == 0) continue;
    Pair& pair = pairs_[i / 2];
    const std::size_t lane = i % 2;
    pair.x[lane] = point.x();
    pair.y[lane] = point.y();
    pair.z[lane] = point.z();
    pair.u[lane] = seen.uv.x() - camera.cx;
    pair.v[lane] = seen.uv.y() - camera.cy;
    pair.per_sigma[lane] = 1.0 / seen.sigma_px;
    pair.disparity[lane] = seen.has_depth() ? seen.disparity : 0.0;
    pair.per_sigma_depth[lane] = seen.has_depth() ? 1.0 / seen.sigma_disparity_px : 0.0;
    pair.gate[lane] = chi2_gate(seen);
  }
}

void PoseEquations::add(const Pair& pair, const SE3& cam_from_world, bool robust, Sums& sums) const {
  const Eigen::Matrix3d& r = cam_from_world.rotation;
  const Eigen::Vector3d& t = cam_from_world.translation;
  const Two x = r(0, 0) * pair.x + r(0, 1) * pair.y + r(0, 2) * pair.z + t(0);
  const Two y = r(1, 0) * pair.x + r(1, 1) * pair.y + r(1, 2) * pair.z + t(1);
  const Two z = r(2, 0) * pair.x + r(2, 1) * pair.y + r(2, 2) * pair.z + t(2);
  const auto [inverse, slope] = inverse_depth(z);

  // Rows of the Jacobian (reprojection_jacobian, then p x row for the rotation), their zeros left out:
  //   u: gu * [inverse, 0, -x slope, -xy slope, z inverse + x^2 slope, -y inverse]
  //   v: gv * [0, inverse, -y slope, -z inverse - y^2 slope, xy slope, x inverse]
  //   disparity: gd * [0, 0, slope, y slope, -x slope, 0]
  const Two gu = -camera_.fx * pair.per_sigma, gv = -camera_.fy * pair.per_sigma;
  const Two gd = camera_.bf * pair.per_sigma_depth;
  const Two x_slope = x * slope, y_slope = y * slope, xy_slope = x * y_slope, z_inverse = z * inverse;
  const Two u0 = gu * inverse, u2 = -gu * x_slope, u3 = -gu * xy_slope;
  const Two u4 = gu * (z_inverse + x * x_slope), u5 = -u0 * y;
  const Two v1 = gv * inverse, v2 = -gv * y_slope, v3 = -gv * (z_inverse + y * y_slope);
  const Two v4 = gv * xy_slope, v5 = v1 * x;
  const Two d2 = gd * slope, d3 = gd * y_slope, d4 = -gd * x_slope;
  const Two eu = pair.u * pair.per_sigma + u0 * x;
  const Two ev = pair.v * pair.per_sigma + v1 * y;
  const Two ed = pair.disparity * pair.per_sigma_depth - gd * inverse;

  const Two chi2 = eu * eu + ev * ev + ed * ed;
  Two w = pair.active;
  if (robust) {
    const auto linear = chi2 > pair.gate;
    const Two ratio = pair.gate / chi2;
    const Two root = {std::sqrt(ratio[0]), std::sqrt(ratio[1])};
    const Two huber_cost = linear ? 2.0 * chi2 * root - pair.gate : chi2;
    w = linear ? w * root : w;
    sums.cost += pair.active * huber_cost;
  } else {
    sums.cost += w * chi2;
  }

  const Two wu0 = w * u0, wu2 = w * u2, wu3 = w * u3, wu4 = w * u4, wu5 = w * u5;
  const Two wv1 = w * v1, wv2 = w * v2, wv3 = w * v3, wv4 = w * v4, wv5 = w * v5;
  const Two wd2 = w * d2, wd3 = w * d3, wd4 = w * d4;
  sums.h00 += wu0 * u0;
  sums.h02 += wu0 * u2;
  sums.h03 += wu0 * u3;
  sums.h04 += wu0 * u4;
  sums.h05 += wu0 * u5;
  sums.h11 += wv1 * v1;
  sums.h12 += wv1 * v2;
  sums.h13 += wv1 * v3;
  sums.h14 += wv1 * v4;
  sums.h15 += wv1 * v5;
  sums.h22 += wu2 * u2 + wv2 * v2 + wd2 * d2;
  sums.h23 += wu2 * u3 + wv2 * v3 + wd2 * d3;
  sums.h24 += wu2 * u4 + wv2 * v4 + wd2 * d4;
  sums.h25 += wu2 * u5 + wv2 * v5;
  sums.h33 += wu3 * u3 + wv3 * v3 + wd3 * d3;
  sums.h34 += wu3 * u4 + wv3 * v4 + wd3 * d4;
  sums.h35 += wu3 * u5 + wv3 * v5;
  sums.h44 += wu4 * u4 + wv4 * v4 + wd4 * d4;
  sums.h45 += wu4 * u5 + wv4 * v5;
  sums.h55 += wu5 * u5 + wv5 * v5;
  sums.g0 += wu0 * eu;
  sums.g1 += wv1 * ev;
  sums.g2 += wu2 * eu + wv2 * ev + wd2 * ed;
  sums.g3 += wu3 * eu + wv3 * ev + wd3 * ed;
  sums.g4 += wu4 * eu + wv4 * ev + wd4 * ed;
  sums.g5 += wu5 * eu + wv5 * ev;
}

PoseModel PoseEquations::linearize(const SE3& cam_from_world, bool robust) const {
  Sums sums;
  for (const Pair& pair : pairs_) add(pair, cam_from_world, robust, sums);
  return sums.collect();
}

/// Chi-square over its gate of every observation; infinite when invalid or not in front of the camera.
std::vector<double> PoseEquations::chi2_per_gate(const SE3& cam_from_world) const {
  std::vector<double> ratios(valid_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < valid_.size(); ++i) {
    const Pair& pair = pairs_[i / 2];
    const std::size_t lane = i % 2;
    const Eigen::Vector3d p = cam_from_world * Eigen::Vector3d(pair.x[lane], pair.y[lane], pair.z[lane]);
    if (valid_[i] == 0 || p.z() <= kMinDepthM) continue;
    const double inverse = 1.0 / p.z();
    const double eu = (pair.u[lane] - camera_.fx * p.x() * inverse) * pair.per_sigma[lane];
    const double ev = (pair.v[lane] - camera_.fy * p.y() * inverse) * pair.per_sigma[lane];
    const double ed = (pair.disparity[lane] - camera_.bf * inverse) * pair.per_sigma_depth[lane];
    ratios[i] = (eu * eu + ev * ev + ed * ed) / pair.gate[lane];
  }
  return ratios;
}

PoseEquations::Selection PoseEquations::select(const SE3& cam_from_world, Gate gate) {
  const std::vector<double> ratios = chi2_per_gate(cam_from_world);
  double limit = std::numeric_limits<double>::max();
  if (gate != Gate::kNone) limit = 1.0;
  if (gate == Gate::kRelaxed && !ratios.empty()) limit = std::max(1.0, relaxed_limit(ratios));
  Selection selection;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const bool chosen = ratios[i] <= limit;
    selection.changed = selection.changed || chosen != active(i);
    Pair& pair = pairs_[i / 2];
    pair.active[i % 2] = chosen ? 1.0 : 0.0;
    if (!chosen) continue;
    ++selection.n_active;
    selection.chi2 += ratios[i] * pair.gate[i % 2];
  }
  return selection;
}

}  // namespace cpslam
