#pragma once

#include <span>

#include "util/random.h"

namespace cpslam {

/// A depth inside a person's box, and how likely its place in the box is to be on the person.
struct DepthSample {
  float depth_m = 0.0F;  ///< > 0
  float weight = 1.0F;   ///< > 0
};

/// The depths of a person: normal with mean and standard deviation; those within gate_m of the mean belong.
struct SdfModel {
  float mean_m = 0.0F;
  float sigma_m = 0.0F;
  float gate_m = 0.0F;
  float share = 0.0F;  ///< of the samples' weight inside the gate; 0: no model

  [[nodiscard]] bool valid() const { return share > 0.0F; }
  [[nodiscard]] bool contains(float depth_m) const {
    return depth_m >= mean_m - gate_m && depth_m <= mean_m + gate_m;
  }
};

/// Fits the dominant near surface among the depths of one box by MLESAC (Torr and Zisserman 2000) with K = 20
/// hypotheses of two draws each; docs/method.md has the formulas. One sample is a model of its own, none
/// gives no model, equal depths give one of the least width. Deterministic but for the generator.
/// Thread-safe.
[[nodiscard]] SdfModel fit_sdf_model(std::span<const DepthSample> samples, Random& random);

}  // namespace cpslam
