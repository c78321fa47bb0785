#include "detection_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {
namespace {

struct Times {
  double median = 0.0, p95 = 0.0, max = 0.0;
};

/// Nearest-rank percentile of sorted values, at least one.
double percentile(const std::vector<double>& sorted, double fraction) {
  const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

Times times_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {percentile(values, 0.5), percentile(values, 0.95), values.back()};
}

Times times_of(const DetectionReport& report) {
  std::vector<double> values;
  for (const LookedAt& picture : report.pictures) values.push_back(picture.ms);
  return times_of(std::move(values));
}

/// In floats, and the 8-bit time of each picture as a share of its float time. Empty without --compare-float.
struct Comparison {
  Times float_ms, ratio;
};
std::optional<Comparison> comparison_of(const DetectionReport& report) {
  std::vector<double> float_ms, ratios;
  for (const LookedAt& picture : report.pictures) {
    if (!picture.float_ms) continue;
    float_ms.push_back(*picture.float_ms);
    ratios.push_back(picture.ms / *picture.float_ms);
  }
  if (ratios.empty()) return std::nullopt;
  return Comparison{times_of(std::move(float_ms)), times_of(std::move(ratios))};
}

nlohmann::ordered_json json_of(const Times& times) {
  return {{"p50", times.median}, {"p95", times.p95}, {"max", times.max}};
}

nlohmann::ordered_json settings_json(const DetectorSettings& s) {
  return {{"model_cfg", s.model_cfg},
          {"model_weights", s.model_weights},
          {"input_width", s.input_width},
          {"input_height", s.input_height},
          {"confidence_threshold", s.confidence_threshold},
          {"weak_confidence_threshold", s.weak_confidence_threshold},
          {"nms_threshold", s.nms_threshold},
          {"classes", s.classes},
          {"n_threads", s.n_threads},
          {"quantise", s.quantise},
          {"calibration", s.calibration}};
}

std::size_t count_boxes(const DetectionReport& report) {
  std::size_t n = 0;
  for (const LookedAt& picture : report.pictures) n += picture.boxes;
  return n;
}

}  // namespace

std::string to_json(const DetectionReport& report) {
  nlohmann::ordered_json json = {{"version", report.version},
                                 {"source", report.source},
                                 {"network", report.network},
                                 {"settings", settings_json(report.settings)},
                                 {"interrupted", report.interrupted},
                                 {"boxes", count_boxes(report)},
                                 {"detection_ms", json_of(times_of(report))}};
  json["compared"] = nullptr;
  if (const std::optional<Comparison> compared = comparison_of(report)) {
    json["compared"] = {{"float_ms", json_of(compared->float_ms)}, {"time_ratio", json_of(compared->ratio)}};
  }
  json["left_out"] = report.left_out;
  json["pictures"] = nlohmann::ordered_json::array();
  for (const LookedAt& picture : report.pictures) {
    nlohmann::ordered_json row = {{"picture", picture.key},
                                  {"width", picture.width},
                                  {"height", picture.height},
                                  {"boxes", picture.boxes},
                                  {"ms", picture.ms}};
    if (picture.float_ms) row["float_ms"] = *picture.float_ms;
    json["pictures"].push_back(std::move(row));
  }
  // Names of files need not be UTF-8.
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string to_text(const DetectionReport& report) {
  const Times times = times_of(report);
  std::string text = "network     " + report.network + "\n";
  const DetectorSettings& settings = report.settings;
  text += line("pictures    %zu: %zu boxes of confidence %g and more", report.pictures.size(),
               count_boxes(report), settings.confidence_threshold);
  if (settings.weak_confidence_threshold < settings.confidence_threshold)
    text += line("            and of %g and more where they go on from a box before",
                 settings.weak_confidence_threshold);
  if (!report.left_out.empty())
    text += line("            %zu could not be read (see the warnings)", report.left_out.size());
  if (report.interrupted) text += "            interrupted: the pictures after that were not looked at\n";
  text += line("detection   %.1f ms a picture (median), %.1f ms (95 %%), %.1f ms (max)", times.median,
               times.p95, times.max);
  if (const std::optional<Comparison> compared = comparison_of(report)) {
    text += line("in floats   %.1f ms a picture (median), %.1f ms (95 %%); 8-bit / float %.2f (median)",
                 compared->float_ms.median, compared->float_ms.p95, compared->ratio.median);
  }
  return text;
}

}  // namespace cpslam::program
