#include "detect/yolo_detector.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>

#include "cpslam/error.h"
#include "detect/bgr_picture.h"
#include "detect/calibration_pictures.h"
#include "detect/hysteresis_detector.h"

namespace cpslam {
namespace {

/// Each adds about two forward passes' time to the start. Between 1 and 32, more brought no better boxes.
constexpr std::size_t kCalibrationPictures = 8;
constexpr std::size_t kFewestToCompare = 3;  // people, to tell a ruined network from chance

const DetectorSettings& checked(const DetectorSettings& settings) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  const auto is_confidence = [](double value) { return value > 0.0 && value <= 1.0; };
  if (!is_confidence(settings.confidence_threshold)) {
    throw InputError("Detector.confidenceThreshold must lie in (0, 1]");
  }
  if (!is_confidence(settings.weak_confidence_threshold)) {
    throw InputError("Detector.weakConfidenceThreshold must lie in (0, 1]");
  }
  if (!is_share(settings.nms_threshold)) throw InputError("Detector.nmsThreshold must lie in [0, 1]");
  if (settings.input_width < 0 || settings.input_height < 0) {
    throw InputError("Detector.inputWidth and Detector.inputHeight must not be negative");
  }
  if (settings.n_threads < 0) throw InputError("Detector.threads must not be negative");
  if (settings.n_threads > 0) cv::setNumThreads(settings.n_threads);
  return settings;
}

void check_classes(const std::vector<int>& classes, int n_classes, const std::string& config) {
  if (classes.empty()) throw InputError("no class of '" + config + "' is chosen that counts as people");
  for (const int index : classes) {
    if (index >= 0 && index < n_classes) continue;
    throw InputError("there is no class " + std::to_string(index) + ": those of '" + config + "' are 0 to " +
                     std::to_string(n_classes - 1));
  }
}

double milliseconds_for(YoloNetwork& network, const cv::Mat& picture) {
  const auto begin = std::chrono::steady_clock::now();
  (void)network.run(picture);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

YoloDetector::YoloDetector(const DetectorSettings& settings, const Log& log)
    : settings_(checked(settings)),
      network_(settings.model_cfg, settings.model_weights, {settings.input_width, settings.input_height}),
      letterbox_(network_.description().input, network_.description().input) {
  check_classes(settings.classes, network_.description().n_classes, settings.model_cfg);
  if (settings.quantise) quantise(log);
}

void YoloDetector::quantise(const Log& log) {
  if (settings_.calibration.empty()) {
    throw InputError("running '" + settings_.model_cfg +
                     "' in 8-bit integers needs a folder of pictures to calibrate it on");
  }
  const std::vector<cv::Mat> pictures =
      read_calibration_pictures(settings_.calibration, kCalibrationPictures, network_.description().input);
  const double float_ms = milliseconds_for(network_, pictures.front());
  const std::size_t in_floats = count_people(pictures);
  network_.quantise(pictures);
  const std::size_t in_integers = count_people(pictures);
  // OpenCV 4.10 loses everybody where 4.6 loses next to nobody.
  if (in_floats >= kFewestToCompare && 2 * in_integers < in_floats) {
    throw InputError("8-bit integers ruin '" + settings_.model_weights + "' with OpenCV " CV_VERSION ": of " +
                     std::to_string(in_floats) + " people in the pictures it was calibrated on it finds " +
                     std::to_string(in_integers) + "; leave --quantise out");
  }
  const double int_ms = milliseconds_for(network_, pictures.front());
  const std::string times = name() + ": " + std::to_string(static_cast<int>(int_ms)) + " ms, in floats " +
                            std::to_string(static_cast<int>(float_ms)) + " ms";
  // OpenCV's 8-bit depthwise convolutions are slower than its others.
  if (int_ms > float_ms) {
    log.warning(times + ": this network is faster without");
  } else {
    log.info(times);
  }
}

std::size_t YoloDetector::count_people(const std::vector<cv::Mat>& pictures) {
  std::size_t n = 0;
  for (const cv::Mat& picture : pictures) n += boxes_in(picture).size();
  return n;
}

std::vector<PersonBox> YoloDetector::boxes_in(const cv::Mat& picture) {
  return decode_yolo(network_.run(picture), network_.description().input, settings_.classes,
                     {settings_.confidence_threshold, settings_.nms_threshold});
}

std::vector<PersonBox> YoloDetector::detect(const cv::Mat& colour, double /*time_s*/) {
  const cv::Mat bgr = to_bgr(colour);
  if (bgr.size() != letterbox_.image()) letterbox_ = Letterbox(bgr.size(), network_.description().input);
  std::vector<PersonBox> boxes = boxes_in(letterbox_.fit(bgr));
  for (PersonBox& box : boxes) box = letterbox_.to_image(box);
  return boxes;
}

std::string YoloDetector::name() const {
  const cv::Size input = network_.description().input;
  return "YOLO " + settings_.model_weights + ", " + std::to_string(input.width) + " x " +
         std::to_string(input.height) + (settings_.quantise ? ", 8-bit" : "");
}

std::unique_ptr<PersonDetector> make_yolo_detector(const DetectorSettings& settings, const Log& log) {
  const double first = settings.confidence_threshold;
  DetectorSettings all = checked(settings);
  if (settings.weak_confidence_threshold >= first) return std::make_unique<YoloDetector>(settings, log);
  all.confidence_threshold = settings.weak_confidence_threshold;
  return std::make_unique<HysteresisDetector>(std::make_unique<YoloDetector>(all, log), first);
}

}  // namespace cpslam
