#include "common/people_report.h"

#include <nlohmann/json.hpp>

#include "common/report_text.h"
#include "common/setting_names.h"

namespace cpslam::program {
namespace {

/// 0 when there is nothing to divide by.
double ratio(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

double ratio(std::size_t part, std::size_t whole) {
  return ratio(static_cast<double>(part), static_cast<double>(whole));
}

double detections_per_s(const RunReport& report) {
  return ratio(static_cast<double>(report.statistics.people.detections), report.sequence_s);
}

}  // namespace

bool has_people(const RunReport& report) {
  return report.settings.detector.kind != DetectorKind::kNone || report.statistics.people.detections > 0;
}

nlohmann::ordered_json people_json(const RunReport& report) {
  const PeopleStatistics& people = report.statistics.people;
  nlohmann::ordered_json json = {
      {"detections", people.detections},
      {"detector_failures", people.detector_failures},
      {"detections_per_frame", ratio(people.detections, report.statistics.frames)},
      {"detections_per_s", detections_per_s(report)},
      {"boxes", people.boxes},
      {"boxes_per_detection", ratio(people.boxes, people.detections)},
      {"boxes_age_s", {{"mean", people.mean_boxes_age_s}, {"max", people.max_boxes_age_s}}},
      {"keypoints", people.keypoints},
      {"removed_keypoints", people.removed_keypoints},
      {"removed_ratio", ratio(people.removed_keypoints, people.keypoints)},
      {"reinstated_keypoints", people.reinstated_keypoints},
      {"reinstated_ratio", ratio(people.reinstated_keypoints, people.keypoints)},
      {"extended_frames", people.extended_frames}};
  json["detector_ms"] = nullptr;
  if (const StageTimes* detect = find_stage(report.statistics, "detect")) {
    json["detector_ms"] = {{"p50", detect->p50_ms}, {"p95", detect->p95_ms}, {"max", detect->max_ms}};
  }
  return json;
}

std::string people_text(const RunReport& report) {
  const PeopleStatistics& people = report.statistics.people;
  std::string text =
      line("people      %zu detections (%.1f a second), %.1f boxes each, %.0f ms old (mean), %.0f ms (max)",
           people.detections, detections_per_s(report), ratio(people.boxes, people.detections),
           1000.0 * people.mean_boxes_age_s, 1000.0 * people.max_boxes_age_s);
  text += line("            %.1f %% of the keypoints removed, %.1f %% on people who do not move kept",
               100.0 * ratio(people.removed_keypoints, people.keypoints),
               100.0 * ratio(people.reinstated_keypoints, people.keypoints));
  if (people.extended_frames > 0)
    text += line("            %zu frames were extracted again beside the people", people.extended_frames);
  if (people.detector_failures > 0)
    text += line("            the detector failed on %zu images (see the errors)", people.detector_failures);
  if (const StageTimes* detect = find_stage(report.statistics, "detect")) {
    text += line("detector    %.1f ms an image (median), %.1f ms (95 %%), %.1f ms (max)", detect->p50_ms,
                 detect->p95_ms, detect->max_ms);
  }
  return text;
}

nlohmann::ordered_json detector_settings_json(const Settings& settings) {
  const DetectorSettings& detector = settings.detector;
  return {{"kind", name_of(detector.kind)},
          {"boxes_file", detector.boxes_file},
          {"model_cfg", detector.model_cfg},
          {"model_weights", detector.model_weights},
          {"input_width", detector.input_width},
          {"input_height", detector.input_height},
          {"confidence_threshold", detector.confidence_threshold},
          {"weak_confidence_threshold", detector.weak_confidence_threshold},
          {"nms_threshold", detector.nms_threshold},
          {"classes", detector.classes},
          {"n_threads", detector.n_threads},
          {"quantise", detector.quantise},
          {"calibration", detector.calibration},
          {"timeout_s", detector.timeout_s},
          {"policy", name_of(boxes_policy(settings))},
          {"pretend_rate_hz", detector.pretend_rate_hz},
          {"pretend_delay_s", detector.pretend_delay_s}};
}

nlohmann::ordered_json people_settings_json(const PeopleSettings& settings) {
  return {{"filter", name_of(settings.filter)}, {"reinstate_still", settings.reinstate_still}};
}

}  // namespace cpslam::program
