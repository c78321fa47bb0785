#include "common/network_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <utility>

#include "common/class_names.h"
#include "cpslam/error.h"
#include "cpslam/person_detector.h"

namespace cpslam::program {
namespace {

constexpr int kLargestSide = 4096;  // as Detector.inputWidth

/// "416" or "416x320", px; empty when it is neither.
std::vector<int> parse_size(const std::string& text) {
  std::vector<int> sides(1, 0);
  for (const char c : text) {
    if (c == 'x' && sides.size() == 1 && sides[0] > 0) {
      sides.push_back(0);
    } else if (c >= '0' && c <= '9' && sides.back() <= kLargestSide) {
      sides.back() = 10 * sides.back() + (c - '0');
    } else {
      return {};
    }
  }
  if (sides.size() == 1) sides.push_back(sides[0]);
  for (const int side : sides) {
    if (side < 1 || side > kLargestSide) return {};
  }
  return sides;
}

void add_size_option(CLI::App& app, const std::string& group, std::vector<int>& size) {
  const auto take = [&size](const std::string& text) {
    size = parse_size(text);
    if (size.empty())
      throw CLI::ValidationError("--input-size", "'" + text + "' is not of the form 416 or 416x320");
  };
  app.add_option_function<std::string>(
         "--input-size", take,
         "The network's input, px, multiples of its largest stride; default as its .cfg says")
      ->type_name("W[xH]")
      ->group(group);
}

}  // namespace

void add_network_options(CLI::App& app, const std::string& group, NetworkOptions& options) {
  app.add_option("--model", options.model, "Darknet YOLO network; default the one that comes with CP-SLAM")
      ->expected(2)
      ->type_name("CFG WEIGHTS")
      ->group(group);
  app.add_option("--classes", options.classes,
                 "The network's classes that count as people, with commas: indices, or names in the .names\n"
                 "file beside CFG; default 0")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("CLASSES")
      ->group(group);
  app.add_option("--quantise", options.calibration,
                 "Run the network in 8-bit integers, calibrated on the pictures in this folder")
      ->type_name("DIR")
      ->group(group);
  add_size_option(app, group, options.input_size);
  app.add_option("--confidence", options.confidence, "Least confidence of a box around somebody new")
      ->check(CLI::Range(0.001, 1.0))
      ->type_name("C")
      ->group(group);
  app.add_option("--weak-confidence", options.weak_confidence,
                 "Least confidence of a box around somebody who was in one not long before; single pictures\n"
                 "have none before; nothing when not below --confidence")
      ->check(CLI::Range(0.001, 1.0))
      ->type_name("C")
      ->group(group);
  app.add_option("--nms", options.nms, "Overlap (IoU) above which the less confident of two boxes goes")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("IOU")
      ->group(group);
  app.add_option("--detector-threads", options.n_threads, "OpenCV's threads, in the whole process")
      ->check(CLI::Range(1, 256))
      ->type_name("N")
      ->group(group);
}

std::string first_given(const NetworkOptions& options) {
  const std::array<std::pair<bool, const char*>, 8> given{
      {{!options.model.empty(), "--model"},
       {!options.classes.empty(), "--classes"},
       {!options.calibration.empty(), "--quantise"},
       {!options.input_size.empty(), "--input-size"},
       {options.confidence.has_value(), "--confidence"},
       {options.weak_confidence.has_value(), "--weak-confidence"},
       {options.nms.has_value(), "--nms"},
       {options.n_threads.has_value(), "--detector-threads"}}};
  for (const auto& [is_given, name] : given) {
    if (is_given) return name;
  }
  return {};
}

void apply(const NetworkOptions& options, DetectorSettings& settings) {
  if (!options.model.empty()) {
    settings.model_cfg = options.model.at(0);
    settings.model_weights = options.model.at(1);
  } else if (const std::optional<DetectorModel> bundled = bundled_detector_model()) {
    settings.model_cfg = bundled->cfg;
    settings.model_weights = bundled->weights;
  } else {
    throw InputError("no network: give --model CFG WEIGHTS (" + no_bundled_detector_model_text() + ")");
  }
  if (!options.classes.empty()) settings.classes = class_indices(options.classes, settings.model_cfg);
  settings.quantise = !options.calibration.empty();
  settings.calibration = options.calibration;
  if (!options.input_size.empty()) {
    settings.input_width = options.input_size.at(0);
    settings.input_height = options.input_size.at(1);
  }
  settings.confidence_threshold = options.confidence.value_or(settings.confidence_threshold);
  settings.weak_confidence_threshold = options.weak_confidence.value_or(settings.weak_confidence_threshold);
  settings.nms_threshold = options.nms.value_or(settings.nms_threshold);
  settings.n_threads = options.n_threads.value_or(settings.n_threads);
}

}  // namespace cpslam::program
