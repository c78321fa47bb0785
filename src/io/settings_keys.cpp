#include "io/settings_keys.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <numeric>
#include <vector>

namespace cpslam {
namespace {

using M = SettingsMember;
constexpr bool kRequired = true;

// name, member, lowest, highest, required
constexpr std::array kKeys = std::to_array<SettingsKey>({
    {"Camera.fx", [](Settings& s) -> M { return &s.camera.fx; }, 1.0, 1e5, kRequired},
    {"Camera.fy", [](Settings& s) -> M { return &s.camera.fy; }, 1.0, 1e5, kRequired},
    {"Camera.cx", [](Settings& s) -> M { return &s.camera.cx; }, -1e5, 1e5, kRequired},
    {"Camera.cy", [](Settings& s) -> M { return &s.camera.cy; }, -1e5, 1e5, kRequired},
    {"Camera.k1", [](Settings& s) -> M { return &s.camera.k1; }, -100.0, 100.0},
    {"Camera.k2", [](Settings& s) -> M { return &s.camera.k2; }, -100.0, 100.0},
    {"Camera.p1", [](Settings& s) -> M { return &s.camera.p1; }, -10.0, 10.0},
    {"Camera.p2", [](Settings& s) -> M { return &s.camera.p2; }, -10.0, 10.0},
    {"Camera.k3", [](Settings& s) -> M { return &s.camera.k3; }, -100.0, 100.0},
    {"Camera.width", [](Settings& s) -> M { return &s.camera.width; }, 64, 8192},
    {"Camera.height", [](Settings& s) -> M { return &s.camera.height; }, 64, 8192},
    {"Camera.fps", [](Settings& s) -> M { return &s.camera.fps; }, 0.1, 1000.0},
    {"Camera.bf", [](Settings& s) -> M { return &s.camera.bf; }, 1e-3, 1e5},
    {"ThDepth", [](Settings& s) -> M { return &s.tracking.th_depth; }, 1e-3, 1e5},
    {"DepthMapFactor", [](Settings& s) -> M { return &s.camera.depth_map_factor; }, 1e-5, 1e7},
    {"ORBextractor.nFeatures", [](Settings& s) -> M { return &s.orb.n_features; }, 50, 100000},
    {"ORBextractor.scaleFactor", [](Settings& s) -> M { return &s.orb.scale_factor; }, 1.01, 4.0},
    {"ORBextractor.nLevels", [](Settings& s) -> M { return &s.orb.n_levels; }, 1, 16},
    {"ORBextractor.iniThFAST", [](Settings& s) -> M { return &s.orb.ini_th_fast; }, 1, 254},
    {"ORBextractor.minThFAST", [](Settings& s) -> M { return &s.orb.min_th_fast; }, 1, 254},
    {"Tracking.minInitialPoints", [](Settings& s) -> M { return &s.tracking.min_initial_points; }, 10,
     100000},
    {"Tracking.minInliers", [](Settings& s) -> M { return &s.tracking.min_inliers; }, 6, 10000},
    {"Tracking.newMapAfter", [](Settings& s) -> M { return &s.tracking.new_map_after_s; }, 0.0, 3600.0},
    {"Mapping.localBaIterations", [](Settings& s) -> M { return &s.mapping.local_ba_iterations; }, 0, 1000},
    {"Mapping.queueCapacity", [](Settings& s) -> M { return &s.mapping.queue_capacity; }, 1, 1000},
    {"LoopClosing.minInliers", [](Settings& s) -> M { return &s.loops.min_inliers; }, 10, 10000},
    {"LoopClosing.consistentKeyframes", [](Settings& s) -> M { return &s.loops.consistent_keyframes; }, 1,
     100},
    {"Detector.inputWidth", [](Settings& s) -> M { return &s.detector.input_width; }, 0, 4096},
    {"Detector.inputHeight", [](Settings& s) -> M { return &s.detector.input_height; }, 0, 4096},
    {"Detector.confidenceThreshold", [](Settings& s) -> M { return &s.detector.confidence_threshold; }, 0.001,
     1.0},
    {"Detector.weakConfidenceThreshold",
     [](Settings& s) -> M { return &s.detector.weak_confidence_threshold; }, 0.001, 1.0},
    {"Detector.nmsThreshold", [](Settings& s) -> M { return &s.detector.nms_threshold; }, 0.0, 1.0},
    {"Detector.threads", [](Settings& s) -> M { return &s.detector.n_threads; }, 0, 256},
    {"Detector.timeout", [](Settings& s) -> M { return &s.detector.timeout_s; }, 0.1, 3600.0},
});

constexpr auto kIgnored = std::to_array<std::string_view>({
    "Camera.RGB",  // images come as B,G,R everywhere
    "Viewer.KeyFrameSize",
    "Viewer.KeyFrameLineWidth",
    "Viewer.GraphLineWidth",
    "Viewer.PointSize",
    "Viewer.CameraSize",
    "Viewer.CameraLineWidth",
    "Viewer.ViewpointX",
    "Viewer.ViewpointY",
    "Viewer.ViewpointZ",
    "Viewer.ViewpointF",
    "LEFT.height",
    "LEFT.width",
    "LEFT.D",
    "LEFT.K",
    "LEFT.R",
    "LEFT.P",
    "RIGHT.height",
    "RIGHT.width",
    "RIGHT.D",
    "RIGHT.K",
    "RIGHT.R",
    "RIGHT.P",
});

/// Edit distance (Levenshtein 1966) that takes no notice of case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::span<const SettingsKey> settings_keys() {
  return kKeys;
}

const SettingsKey* find_settings_key(std::string_view name) {
  const auto* const found =
      std::find_if(kKeys.begin(), kKeys.end(), [&](const SettingsKey& k) { return k.name == name; });
  return found == kKeys.end() ? nullptr : &*found;
}

bool is_ignored_settings_key(std::string_view name) {
  return std::find(kIgnored.begin(), kIgnored.end(), name) != kIgnored.end();
}

std::string nearest_settings_key(std::string_view name) {
  std::string_view nearest;
  // Further away than half its length, a suggestion only confuses.
  std::size_t nearest_distance = name.size() / 2 + 1;
  const auto consider = [&](std::string_view known) {
    const std::size_t distance = edit_distance(name, known);
    if (distance >= nearest_distance) return;
    nearest_distance = distance;
    nearest = known;
  };
  if (name.size() > 100) return {};
  for (const SettingsKey& key : kKeys) consider(key.name);
  for (const std::string_view key : kIgnored) consider(key);
  return std::string(nearest);
}

std::string range_error(const SettingsKey& key, double value) {
  if (value >= key.lowest && value <= key.highest) return {};
  return std::string(key.name) + ": " + number_text(value) + " is outside its range, " +
         number_text(key.lowest) + " to " + number_text(key.highest);
}

std::string number_text(double value) {
  std::array<char, 40> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

}  // namespace cpslam
