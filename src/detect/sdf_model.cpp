#include "detect/sdf_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

constexpr int kHypotheses = 20;
constexpr int kRefits = 2;
// A torso is not one depth. Thinner hypotheses would let a flat wall, every sample of it at the same depth,
// beat a person by the height of its density alone.
constexpr float kMinSigmaM = 0.1F;
constexpr float kMaxSigmaM = 0.25F;
constexpr float kGateSigmas = 2.5F;
constexpr float kPersonShare = 0.6F;   // of the mixture
constexpr float kInFrontShare = 0.1F;  // of what is not the person: most of it is behind
constexpr float kMinRangeM = 0.5F;     // of the depths in the box, for the uniform density
constexpr float kInvSqrtTwoPi = 0.39894228F;
constexpr float kLostExponent = 18.0F;  // exp(-18) is less than half of a float's last bit

/// The samples of one box with what does not change from hypothesis to hypothesis.
class Box {
 public:
  explicit Box(std::span<const DepthSample> samples) : samples_(samples) {
    float nearest = samples.front().depth_m;
    float farthest = nearest;
    cumulated_.reserve(samples.size());
    for (const DepthSample& s : samples) {
      total_ += static_cast<double>(s.weight);
      cumulated_.push_back(total_);
      nearest = std::min(nearest, s.depth_m);
      farthest = std::max(farthest, s.depth_m);
    }
    range_m_ = std::max(farthest - nearest, kMinRangeM);
  }

  [[nodiscard]] float draw(Random& random) const {
    const double at = random.uniform() * total_;
    const auto found = std::upper_bound(cumulated_.begin(), cumulated_.end(), at);
    const auto index =
        std::min<std::size_t>(static_cast<std::size_t>(found - cumulated_.begin()), samples_.size() - 1);
    return samples_[index].depth_m;
  }

  /// Formulas (3) and (4) over the samples inside the model's gate, and their share.
  [[nodiscard]] SdfModel refit(const SdfModel& model) const {
    double weight = 0.0, sum = 0.0, squares = 0.0;
    for (const DepthSample& s : samples_) {
      if (!model.contains(s.depth_m)) continue;
      const auto w = static_cast<double>(s.weight);
      const auto offset = static_cast<double>(s.depth_m - model.mean_m);
      weight += w;
      sum += w * offset;
      squares += w * offset * offset;
    }
    if (weight <= 0.0) return {};
    const double mean = sum / weight;
    const double variance = std::max(0.0, squares / weight - mean * mean);
    return make_model(model.mean_m + static_cast<float>(mean), static_cast<float>(std::sqrt(variance)),
                      static_cast<float>(weight / total_));
  }

  /// Negative log-likelihood of the samples under the mixture: lower is better.
  [[nodiscard]] float cost(const SdfModel& model) const {
    const float peak = kPersonShare * kInvSqrtTwoPi / model.sigma_m;
    const float exponent = -0.5F / (model.sigma_m * model.sigma_m);
    const float uniform = (1.0F - kPersonShare) / range_m_;
    const float in_front = uniform * kInFrontShare;
    const float behind = uniform * (1.0F - kInFrontShare);
    const float log_in_front = std::log(in_front);
    const float log_behind = std::log(behind);
    // Further off the peak is lost in the rounding of what is added to it.
    const float lost = std::log(in_front / peak) - kLostExponent;
    float cost = 0.0F;
    for (const DepthSample& s : samples_) {
      const float d = s.depth_m - model.mean_m;
      const float power = exponent * d * d;
      if (power < lost) {
        cost -= s.weight * (d < 0.0F ? log_in_front : log_behind);
      } else {
        cost -= s.weight * std::log(peak * std::exp(power) + (d < 0.0F ? in_front : behind));
      }
    }
    return cost;
  }

  /// The gate follows formula (6): the more of the box agrees, the wider the tolerance.
  static SdfModel make_model(float mean_m, float sigma_m, float share) {
    const auto noise_m = static_cast<float>(structured_light_sigma_m(static_cast<double>(mean_m)));
    SdfModel model;
    model.mean_m = mean_m;
    model.sigma_m = std::clamp(sigma_m, std::max(kMinSigmaM, noise_m), std::max(kMaxSigmaM, noise_m));
    const float threshold_m = 0.02F * (1.0F + share);
    model.gate_m = std::max(kGateSigmas * model.sigma_m, threshold_m + 3.0F * noise_m);
    model.share = share;
    return model;
  }

 private:
  std::span<const DepthSample> samples_;
  std::vector<double> cumulated_;
  double total_ = 0.0;
  float range_m_ = 0.0F;
};

}  // namespace

SdfModel fit_sdf_model(std::span<const DepthSample> samples, Random& random) {
  if (samples.empty()) return {};
  const Box box(samples);
  SdfModel best;
  float best_cost = 0.0F;
  for (int k = 0; k < kHypotheses; ++k) {
    const float a = box.draw(random);
    const float b = box.draw(random);
    const SdfModel drawn = Box::make_model(0.5F * (a + b), 0.5F * std::abs(a - b), best.share);
    const float cost = box.cost(drawn);
    if (best.valid() && cost >= best_cost) continue;
    const SdfModel refitted = box.refit(drawn);  // for its share, which widens the next gates
    if (!refitted.valid()) continue;
    best = drawn;
    best.share = refitted.share;
    best_cost = cost;
  }
  for (int i = 0; i < kRefits && best.valid(); ++i) best = box.refit(best);
  return best;
}

}  // namespace cpslam
