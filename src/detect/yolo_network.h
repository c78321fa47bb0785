#pragma once

#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "detect/darknet_network.h"

namespace cpslam {

/// A Darknet YOLO network that OpenCV runs on the CPU. Not thread-safe.
class YoloNetwork {
 public:
  /// input: px, a side of 0 as the .cfg says. Runs the network once. Throws InputError naming the file that
  /// is missing, broken, does not fit the other one, or gives nonsense.
  YoloNetwork(const std::string& config_path, const std::string& weights_path, cv::Size input);

  [[nodiscard]] const DarknetNetwork& description() const { return description_; }

  /// From here on runs in 8-bit integers, the range of every layer's values taken from these pictures, each
  /// of the input's size (B,G,R). OpenCV 4.6 runs the network on all of them at once for that and can neither
  /// save the result nor take ranges from elsewhere, so it is done at every start. Throws InputError naming
  /// the .cfg when OpenCV cannot do it for this network.
  void quantise(const std::vector<cv::Mat>& pictures);

  /// What the heads say about a picture of the input's size (B,G,R), as decode_yolo() takes it. What OpenCV
  /// throws becomes a RunError.
  [[nodiscard]] std::vector<cv::Mat> run(const cv::Mat& picture);

 private:
  [[nodiscard]] std::vector<cv::Mat> forward(const cv::Mat& picture);
  void try_out(const std::string& what);

  std::string config_path_;
  DarknetNetwork description_;
  cv::dnn::Net net_;
  std::vector<std::string> heads_;
};

}  // namespace cpslam
