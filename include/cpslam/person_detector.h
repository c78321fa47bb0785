#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/log.h"
#include "cpslam/settings.h"
#include "cpslam/types.h"

namespace cpslam {

/// Finds people, or whatever else moves by itself, in single colour images. Give one of your own to System,
/// or let make_detector() make one. Used from one thread at a time, not always the same one.
class PersonDetector {
 public:
  PersonDetector() = default;
  virtual ~PersonDetector() = default;
  PersonDetector(const PersonDetector&) = delete;
  PersonDetector& operator=(const PersonDetector&) = delete;

  /// colour: CV_8UC3 (B,G,R) or CV_8UC1, as the camera took it, not to be changed. time_s: its stamp. What is
  /// thrown is reported, and tracking goes on with what it knows from earlier images.
  [[nodiscard]] virtual std::vector<PersonBox> detect(const cv::Mat& colour, double time_s) = 0;

  /// For messages: "YOLO models/yc.weights, 416 x 416".
  [[nodiscard]] virtual std::string name() const = 0;
};

/// A Darknet network.
struct DetectorModel {
  std::string cfg;      ///< path
  std::string weights;  ///< path
};

/// The network that comes with CP-SLAM, models/yc.cfg and models/yc.weights: looked for beside the
/// executable, in the installation and in the folder CPSLAM_DATA names, in this order. Empty when it is in
/// none.
[[nodiscard]] std::optional<DetectorModel> bundled_detector_model();

/// Where bundled_detector_model() looks, for a message: "'models/yc.weights' is not in 'A' or 'B'".
[[nodiscard]] std::string no_bundled_detector_model_text();

/// The detector the settings ask for; null for DetectorKind::kNone. Throws InputError naming the file that is
/// missing or broken and the way out.
[[nodiscard]] std::unique_ptr<PersonDetector> make_detector(const DetectorSettings& settings,
                                                            const LogSink& log = {});

}  // namespace cpslam
