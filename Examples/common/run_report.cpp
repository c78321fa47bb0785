#include "common/run_report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "common/loop_report.h"
#include "common/map_report.h"
#include "common/people_report.h"
#include "common/report_text.h"

namespace cpslam::program {
namespace {

double tracked_ratio(const RunReport& report) {
  if (report.frames_in_sequence == 0) return 0.0;
  return static_cast<double>(report.statistics.tracked) / static_cast<double>(report.frames_in_sequence);
}

nlohmann::ordered_json settings_json(const Settings& s) {
  return {{"camera",
           {{"width", s.camera.width},
            {"height", s.camera.height},
            {"fx", s.camera.fx},
            {"fy", s.camera.fy},
            {"cx", s.camera.cx},
            {"cy", s.camera.cy},
            {"k1", s.camera.k1},
            {"k2", s.camera.k2},
            {"p1", s.camera.p1},
            {"p2", s.camera.p2},
            {"k3", s.camera.k3},
            {"fps", s.camera.fps},
            {"bf", s.camera.bf},
            {"depth_map_factor", s.camera.depth_map_factor}}},
          {"orb",
           {{"n_features", s.orb.n_features},
            {"scale_factor", s.orb.scale_factor},
            {"n_levels", s.orb.n_levels},
            {"ini_th_fast", s.orb.ini_th_fast},
            {"min_th_fast", s.orb.min_th_fast}}},
          {"tracking",
           {{"th_depth", s.tracking.th_depth},
            {"min_initial_points", s.tracking.min_initial_points},
            {"min_inliers", s.tracking.min_inliers},
            {"new_map_after_s", s.tracking.new_map_after_s}}},
          {"mapping",
           {{"local_ba_iterations", s.mapping.local_ba_iterations},
            {"queue_capacity", s.mapping.queue_capacity}}},
          {"detector", detector_settings_json(s)},
          {"people", people_settings_json(s.people)},
          {"loops", loop_settings_json(s.loops)},
          {"vocabulary", s.vocabulary},
          {"load_map", s.load_map},
          {"localization", s.localization},
          {"sequential", s.sequential},
          {"realtime", s.realtime},
          {"seed", s.seed}};
}

}  // namespace

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string to_json(const RunReport& report) {
  const Statistics& s = report.statistics;
  nlohmann::ordered_json json = {{"version", report.version},
                                 {"sequence", report.sequence},
                                 {"settings", settings_json(report.settings)},
                                 {"frames", report.frames_in_sequence},
                                 {"tracked", s.tracked},
                                 {"weak", s.weak},
                                 {"bridged", s.bridged},
                                 {"predicted", s.predicted},
                                 {"lost", s.lost},
                                 {"not_initialized", s.not_initialized},
                                 {"unreadable", report.unreadable},
                                 {"dropped", report.dropped},
                                 {"interrupted", report.interrupted},
                                 {"tracked_ratio", tracked_ratio(report)},
                                 {"keyframes", s.keyframes},
                                 {"keyframes_created", s.keyframes_created},
                                 {"map_points", s.map_points},
                                 {"map_points_created", s.map_points_created},
                                 {"dropped_maps", s.dropped_maps},
                                 {"local_bundle_adjustments", s.local_bundle_adjustments}};
  json["stages"] = nlohmann::ordered_json::array();
  for (const StageTimes& stage : s.stages) {
    json["stages"].push_back({{"stage", stage.stage},
                              {"count", stage.count},
                              {"p50_ms", stage.p50_ms},
                              {"p95_ms", stage.p95_ms},
                              {"max_ms", stage.max_ms},
                              {"total_ms", stage.total_ms}});
  }
  json["tracking_ms"] = nullptr;
  if (const StageTimes* track = find_stage(s, "track")) {
    json["tracking_ms"] = {{"p50", track->p50_ms}, {"p95", track->p95_ms}, {"max", track->max_ms}};
  }
  json["loaded_map"] = nullptr;
  if (s.loaded_map) json["loaded_map"] = loaded_map_json(*s.loaded_map);
  json["maps"] = maps_json(s);
  json["people"] = nullptr;
  if (has_people(report)) json["people"] = people_json(report);
  json["loops"] = nullptr;
  if (has_loops(report)) json["loops"] = loops_json(s);
  if (report.dense) json["dense_map"] = dense_json(*report.dense);
  if (report.live) json["live"] = live_json(*report.live);
  json["peak_memory_mb"] = report.peak_memory_mb;
  json["wall_s"] = report.wall_s;
  json["ate"] = nullptr;
  if (report.ate) {
    json["ate"] = {{"pairs", report.ate->pairs},
                   {"rmse_m", report.ate->rmse_m},
                   {"mean_m", report.ate->mean_m},
                   {"median_m", report.ate->median_m},
                   {"max_m", report.ate->max_m}};
  }
  return json.dump(2) + "\n";
}

std::string to_text(const RunReport& report) {
  const Statistics& s = report.statistics;
  std::string text;
  text += line("frames      %zu: %zu tracked (%.1f %%), %zu predicted, %zu lost, %zu before the start",
               report.frames_in_sequence, s.tracked, 100.0 * tracked_ratio(report), s.predicted, s.lost,
               s.not_initialized);
  if (s.weak > 0) text += line("            %zu of the tracked ones weakly: on few points", s.weak);
  if (s.bridged > 0)
    text += line("            %zu where the map shows nothing, carried on from frame to frame", s.bridged);
  if (report.unreadable > 0)
    text += line("            %zu could not be used (see the warnings)", report.unreadable);
  if (report.dropped > 0) text += line("            %zu dropped to keep up with real time", report.dropped);
  if (report.interrupted) text += "            interrupted: the frames after that were not read\n";
  text += line("map         %zu keyframes (%zu made), %zu points (%zu made)", s.keyframes,
               s.keyframes_created, s.map_points, s.map_points_created);
  text += maps_text(s);
  if (s.loaded_map) text += loaded_map_text(*s.loaded_map);
  if (const StageTimes* track = find_stage(s, "track")) {
    text += line("tracking    %.1f ms a frame (median), %.1f ms (95 %%), %.1f ms (max)", track->p50_ms,
                 track->p95_ms, track->max_ms);
  }
  if (report.live) text += live_text(*report.live);
  if (has_people(report)) text += people_text(report);
  if (has_loops(report)) text += loops_text(s);
  if (report.dense) text += dense_text(*report.dense);
  text += line("total       %.1f s, peak memory %.0f MB", report.wall_s, report.peak_memory_mb);
  if (report.ate) {
    text += line("ATE         %.4f m RMSE, %.4f m median, %.4f m max over %zu poses", report.ate->rmse_m,
                 report.ate->median_m, report.ate->max_m, report.ate->pairs);
  }
  return text;
}

}  // namespace cpslam::program
