#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cpslam/person_detector.h"
#include "detect/letterbox.h"
#include "detect/yolo_decoder.h"
#include "detect/yolo_network.h"
#include "util/log.h"

namespace cpslam {

/// Finds people with a Darknet YOLO network: one to three [yolo] heads, 1 to 80 classes. Images of any size
/// are letterboxed into its input; grey ones are taken as colourless ones.
class YoloDetector : public PersonDetector {
 public:
  /// settings: of kind kYolo. n_threads > 0 is handed to cv::setNumThreads, which holds for everything that
  /// OpenCV does in this process from then on, other detectors included: OpenCV has no number per network.
  /// Throws InputError naming the file, or the setting, that is missing, broken or does not fit the network,
  /// and where 8-bit integers leave less than half of the people of the calibration.
  YoloDetector(const DetectorSettings& settings, const Log& log);

  [[nodiscard]] std::vector<PersonBox> detect(const cv::Mat& colour, double time_s) override;
  [[nodiscard]] std::string name() const override;

 private:
  void quantise(const Log& log);
  /// In pictures of the network's input size.
  [[nodiscard]] std::size_t count_people(const std::vector<cv::Mat>& pictures);
  /// In px of the network's input.
  [[nodiscard]] std::vector<PersonBox> boxes_in(const cv::Mat& picture);

  DetectorSettings settings_;
  YoloNetwork network_;
  Letterbox letterbox_;  // of the latest image's size
};

/// The detector that the settings, of kind kYolo, ask for: a YoloDetector, and behind it a HysteresisDetector
/// when the weak threshold is below the other one. Throws as YoloDetector does.
[[nodiscard]] std::unique_ptr<PersonDetector> make_yolo_detector(const DetectorSettings& settings,
                                                                 const Log& log);

}  // namespace cpslam
