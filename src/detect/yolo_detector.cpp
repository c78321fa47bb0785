#include "detect/yolo_detector.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <opencv2/core/utility.hpp>

#include "cpslam/error.h"
#include "detect/bgr_picture.h"
#include "detect/calibration_pictures.h"

namespace cpslam {
namespace {

/// Each adds about two forward passes' time to the start. Between 1 and 32, more brought no better boxes.
constexpr std::size_t kCalibrationPictures = 8;

const DetectorSettings& checked(const DetectorSettings& settings) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!is_share(settings.confidence_threshold) || settings.confidence_threshold <= 0.0) {
    throw InputError("Detector.confidenceThreshold must lie in (0, 1]");
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
  network_.quantise(pictures);
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

std::vector<PersonBox> YoloDetector::detect(const cv::Mat& colour, double /*time_s*/) {
  const cv::Mat bgr = to_bgr(colour);
  if (bgr.size() != letterbox_.image()) letterbox_ = Letterbox(bgr.size(), network_.description().input);
  const std::vector<cv::Mat> outputs = network_.run(letterbox_.fit(bgr));
  std::vector<PersonBox> boxes = decode_yolo(outputs, network_.description().input, settings_.classes,
                                             {settings_.confidence_threshold, settings_.nms_threshold});
  for (PersonBox& box : boxes) box = letterbox_.to_image(box);
  return boxes;
}

std::string YoloDetector::name() const {
  const cv::Size input = network_.description().input;
  return "YOLO " + settings_.model_weights + ", " + std::to_string(input.width) + " x " +
         std::to_string(input.height) + (settings_.quantise ? ", 8-bit" : "");
}

}  // namespace cpslam
