#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/settings.h"

namespace cpslam::program {

/// One picture that was looked at.
struct LookedAt {
  std::string key;
  int width = 0;  ///< px
  int height = 0;
  std::size_t boxes = 0;
  double ms = 0.0;                 ///< letterbox, network and decoding
  std::optional<double> float_ms;  ///< the same for the network in floats, with --compare-float
};

/// What a run of detect_people leaves behind besides boxes.
struct DetectionReport {
  std::string version;
  std::string source;
  std::string network;  ///< PersonDetector::name()
  DetectorSettings settings;
  std::vector<LookedAt> pictures;
  std::vector<std::string> left_out;  ///< keys of unreadable pictures
  bool interrupted = false;
};

[[nodiscard]] std::string to_json(const DetectionReport& report);
[[nodiscard]] std::string to_text(const DetectionReport& report);

}  // namespace cpslam::program
