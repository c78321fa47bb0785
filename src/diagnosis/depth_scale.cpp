#include "diagnosis/depth_scale.h"

#include <array>
#include <string>

#include "diagnosis/percentile.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

struct Spread {
  double near = 0.0, median = 0.0, far = 0.0;  // 2, 50, 98 % of the readings, units

  [[nodiscard]] Spread divided_by(double factor) const {
    return {near / factor, median / factor, far / factor};
  }
};

struct KnownFactor {
  double factor;
  const char* whose;
};
constexpr std::array kKnownFactors{KnownFactor{1000.0, "millimetres: OpenNI2, RealSense, Azure"},
                                   KnownFactor{5000.0, "TUM, Bonn"}};

/// Rooms and people in them, as a camera of this kind sees them.
bool is_plausible(const Spread& metres) {
  return metres.near >= 0.2 && metres.median >= 0.4 && metres.median <= 8.0 && metres.far <= 15.0;
}

std::string factor_text(const KnownFactor& known, const Spread& readings) {
  return format_text("%.0f (%s) makes %.2f m", known.factor, known.whose, readings.median / known.factor);
}

/// The well-known factors that make plausible depths, as text; how many.
std::pair<std::string, int> plausible_factors(const Spread& readings) {
  std::pair<std::string, int> found;
  for (const KnownFactor& known : kKnownFactors) {
    if (!is_plausible(readings.divided_by(known.factor))) continue;
    found.first += (found.second++ == 0 ? "" : ", ") + factor_text(known, readings);
  }
  return found;
}

std::string spread_text(const Spread& metres) {
  return format_text("median depth %.2f m, nearly all within %.2f-%.2f m", metres.median, metres.near,
                     metres.far);
}

void judge_factor(double factor, const Spread& readings, Finding& finding) {
  const Spread metres = readings.divided_by(factor);
  finding.values = {{"median_m", metres.median}, {"near_m", metres.near}, {"far_m", metres.far}};
  finding.what = spread_text(metres) + format_text(" with DepthMapFactor %g", factor);
  const auto [others, n_others] = plausible_factors(readings);
  if (!is_plausible(metres)) {
    finding.level = n_others > 0 ? Level::kError : Level::kWarning;
    finding.what += ": not what rooms look like";
    finding.advice = n_others > 0 ? "correct DepthMapFactor (depth image units per metre): " + others
                                  : "find out how many depth image units make a metre: measure one distance";
    return;
  }
  // Read with 5000, millimetres make a small world that may still pass for a close-up.
  constexpr double kClose_m = 2.0, kMillimetres = 1000.0;
  if (factor > 2.0 * kMillimetres && metres.far < kClose_m &&
      is_plausible(readings.divided_by(kMillimetres))) {
    finding.level = Level::kNote;
    finding.advice = format_text(
        "if something farther than %.1f m was in view, these are millimetres: DepthMapFactor 1000",
        metres.far);
  }
}

void guess_factor(const Spread& readings, Finding& finding) {
  const auto [factors, n_factors] = plausible_factors(readings);
  finding.values = {{"median_units", readings.median}};
  finding.what = format_text("median reading %.0f units", readings.median);
  if (n_factors == 0) {
    finding.level = Level::kWarning;
    finding.what += ": neither DepthMapFactor 1000 nor 5000 makes depths of a room of it";
    finding.advice = "find out how many depth image units make a metre: measure one distance";
    return;
  }
  finding.what += ", as a room's depths: DepthMapFactor " + factors;
  if (n_factors == 1) return;
  finding.level = Level::kNote;
  finding.advice = "measure one distance to choose the factor, and give SETTINGS to have the rest checked";
}

}  // namespace

void DepthScaleCheck::add(const ExaminedFrame& frame) {
  constexpr int kStep = 8;  // px
  for (int y = 0; y < frame.readings.rows; y += kStep) {
    const auto* row = frame.readings.ptr<float>(y);
    for (int x = 0; x < frame.readings.cols; x += kStep) {
      if (row[x] > 0.0F) readings_.push_back(row[x]);
    }
  }
}

Findings DepthScaleCheck::findings() const {
  if (readings_.empty()) return {};  // the depth coverage says it
  const Spread readings{percentile(readings_, 0.02), percentile(readings_, 0.5), percentile(readings_, 0.98)};
  Finding finding;
  finding.check = "depth scale";
  if (factor_) {
    judge_factor(*factor_, readings, finding);
  } else {
    guess_factor(readings, finding);
  }
  return {finding};
}

}  // namespace cpslam::diagnosis
