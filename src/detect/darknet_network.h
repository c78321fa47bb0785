#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

namespace cpslam {

struct DarknetShape {
  int width = 0;
  int height = 0;
  int channels = 0;

  bool operator==(const DarknetShape&) const = default;
};

struct DarknetLayer {
  std::string kind;           ///< "convolutional", ...
  DarknetShape output;        ///< as large as the input size makes it
  int stride = 1;             ///< input px per output cell
  std::size_t n_weights = 0;  ///< floats in the .weights file
};

/// One [yolo] section: it tells where things are on its own grid.
struct YoloHead {
  int grid_width = 0;
  int grid_height = 0;
  int stride = 1;  ///< input px per grid cell
  int n_classes = 0;
  double scale_x_y = 1.0;              ///< how far a box centre can leave its cell, Bochkovskiy et al. 2020
  std::vector<cv::Size2d> anchors_px;  ///< those of the mask, in px of the input
};

/// What a Darknet .cfg says about its network (Redmon's layer definitions).
struct DarknetNetwork {
  cv::Size input;  ///< px
  std::vector<DarknetLayer> layers;
  std::vector<YoloHead> heads;  ///< in the order of the file
  int n_classes = 0;            ///< the same for all heads
  std::size_t n_weights = 0;    ///< floats in the .weights file, its header not counted
  std::string config;           ///< a .cfg of what was understood, for OpenCV
};

/// Works out every layer's shape and weights from the text of a .cfg for the given input size; a side of 0:
/// as the .cfg says. Knows [convolutional], [maxpool], [upsample], [route], [shortcut], [dropout] and [yolo].
/// Throws InputError naming file, line and section for what it does not know, or OpenCV would run otherwise
/// than Darknet, or does not fit together, and when the input size is no multiple of the largest stride.
[[nodiscard]] DarknetNetwork read_darknet_network(const std::string& config_text, const std::string& path,
                                                  cv::Size input_px = {});

/// Throws InputError naming the file when these bytes cannot be the network's .weights: another size than the
/// .cfg asks for (OpenCV takes those silently), an unlikely header, numbers that are not finite.
void check_darknet_weights(const std::string& bytes, const std::string& weights_path,
                           const DarknetNetwork& network, const std::string& config_path);

}  // namespace cpslam
