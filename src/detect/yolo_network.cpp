#include "detect/yolo_network.h"

#include <cmath>
#include <cstddef>

#include "cpslam/error.h"
#include "io/input_file.h"
#include "io/text_table.h"

namespace cpslam {
namespace {

/// The network of the checked .cfg, not of the file, which may have changed since.
cv::dnn::Net load(const DarknetNetwork& description, const std::string& weights) {
  cv::dnn::Net net = cv::dnn::readNetFromDarknet(description.config.data(), description.config.size(),
                                                 weights.data(), weights.size());
  net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  return net;
}

/// Darknet's networks take R,G,B in [0, 1], channel after channel.
cv::Mat to_blob(const std::vector<cv::Mat>& pictures) {
  return cv::dnn::blobFromImages(pictures, 1.0 / 255.0, {}, {}, true);
}

bool fits(const cv::Mat& output, const YoloHead& head) {
  const auto boxes = static_cast<std::size_t>(head.grid_width) * static_cast<std::size_t>(head.grid_height) *
                     head.anchors_px.size();
  return output.dims == 2 && output.type() == CV_32FC1 && output.cols == 5 + head.n_classes &&
         static_cast<std::size_t>(output.rows) == boxes;
}

bool has_nan(const cv::Mat& output) {
  for (int r = 0; r < output.rows; ++r) {
    const float* const row = output.ptr<float>(r);
    for (int c = 0; c < output.cols; ++c) {
      if (std::isnan(row[c])) return true;
    }
  }
  return false;
}

}  // namespace

YoloNetwork::YoloNetwork(const std::string& config_path, const std::string& weights_path, cv::Size input)
    : config_path_(config_path),
      description_(read_darknet_network(read_input_file(config_path), config_path, input)) {
  const std::string weights = read_input_file(weights_path);
  check_darknet_weights(weights, weights_path, description_, config_path);
  const std::string what = "'" + config_path + "' with '" + weights_path + "'";
  try {
    net_ = load(description_, weights);
    heads_ = net_.getUnconnectedOutLayersNames();
    try_out(what);
  } catch (const cv::Exception& error) {
    throw InputError("OpenCV cannot run " + what + ": " + printable(error.err));
  }
}

void YoloNetwork::try_out(const std::string& what) {
  const std::vector<cv::Mat> outputs = forward(cv::Mat(description_.input, CV_8UC3, cv::Scalar::all(114.0)));
  if (outputs.size() != description_.heads.size()) {
    throw InputError(what + " has outputs other than its [yolo] sections: the last layers must be those");
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (!fits(outputs[i], description_.heads[i])) {
      throw InputError("OpenCV reads " + what + " otherwise than Darknet: a [yolo] section gives " +
                       std::to_string(outputs[i].rows) + " boxes");
    }
    if (has_nan(outputs[i])) throw InputError(what + " gives no numbers: the weights are damaged");
  }
}

void YoloNetwork::quantise(const std::vector<cv::Mat>& pictures) {
  const std::string what = "'" + config_path_ + "' in 8-bit integers";
  try {
    net_ = net_.quantize(to_blob(pictures), CV_32F, CV_32F);
    try_out(what);
  } catch (const cv::Exception& error) {
    throw InputError("OpenCV cannot run " + what + ": " + printable(error.err));
  }
}

std::vector<cv::Mat> YoloNetwork::run(const cv::Mat& picture) {
  try {
    return forward(picture);
  } catch (const cv::Exception& error) {
    throw RunError("OpenCV cannot run '" + config_path_ + "': " + printable(error.err));
  }
}

std::vector<cv::Mat> YoloNetwork::forward(const cv::Mat& picture) {
  net_.setInput(to_blob({picture}));
  std::vector<cv::Mat> outputs;
  net_.forward(outputs, heads_);
  return outputs;
}

}  // namespace cpslam
