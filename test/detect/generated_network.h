#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

inline double logistic(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

/// The bytes of a .weights file. Version 0.2 counts the pictures seen in 64 bits, 0.1 in 32.
inline std::string weights_file(const std::vector<float>& weights, int minor = 2) {
  const std::vector<std::int32_t> header(minor >= 2 ? 5 : 4, 0);
  std::string bytes(header.size() * 4 + weights.size() * 4, '\0');
  std::memcpy(bytes.data(), header.data(), header.size() * 4);
  std::memcpy(bytes.data() + 4, &minor, sizeof(std::int32_t));
  std::memcpy(bytes.data() + header.size() * 4, weights.data(), weights.size() * 4);
  return bytes;
}

/// A YOLO network whose output is known without running it. The brightest pixel of a cell decides: red makes
/// the cell's objectness, green the score of class 0, blue that of class 1 (logits of -8 in the dark and +8
/// in full light); all other classes score as the dark does. Where a box lies in its cell and how large it is
/// is the same everywhere: logits `offset` for the centre, `growth` for the sides. Heads have strides of 8,
/// 16 and 32 px.
struct GeneratedNetwork {
  cv::Size input{64, 96};
  int n_classes = 2;
  std::vector<std::vector<cv::Size2d>> anchors{{{8.0, 24.0}}};  // per head
  double scale_x_y = 1.0;
  cv::Point2d offset{0.0, 0.0};
  cv::Point2d growth{0.0, 0.0};

  static constexpr double kDark = -8.0;
  static constexpr double kLight = 8.0;

  static double score(double red, double class_light) {
    const auto lit = [](double light) { return logistic(kDark + (kLight - kDark) * light); };
    return lit(red) * lit(class_light);
  }

  [[nodiscard]] int filters(std::size_t head) const {
    return static_cast<int>(anchors[head].size()) * (5 + n_classes);
  }

  [[nodiscard]] std::string config() const {
    // A first layer with batch normalisation, which the weights make an identity.
    std::string text = "# made by a test\n[net]\nwidth=" + std::to_string(input.width) +
                       "\nheight=" + std::to_string(input.height) + "\nchannels=3\n\n[convolutional]\n" +
                       "batch_normalize=1\nfilters=3\nsize=1\nstride=1\npad=1\nactivation=linear\n";
    for (std::size_t head = 0; head < anchors.size(); ++head) {
      const std::string window = head == 0 ? "8" : "2";
      if (head > 0) text += "\n[route]\nlayers=-3\n";
      text += "\n[maxpool]\nsize=" + window + "\nstride=" + window + "\npadding=0\n";
      text += "\n[convolutional]\nfilters = " + std::to_string(filters(head)) +
              "\nsize=1\nstride=1\npad=1\nactivation=linear\n" + yolo_section(head);
    }
    return text;
  }

  [[nodiscard]] std::vector<float> weights() const {
    // bias, scale, mean, variance, filters: (x - mean) / sqrt(variance) * scale + bias = x.
    std::vector<float> all{0.1F, 0.2F, 0.3F, 2.0F, 1.0F, 0.5F, 0.1F, 0.2F, 0.3F, 4.0F, 1.0F, 0.25F};
    for (int i = 0; i < 9; ++i) all.push_back(i % 4 == 0 ? 1.0F : 0.0F);
    for (std::size_t head = 0; head < anchors.size(); ++head) append_head(head, all);
    return all;
  }

  [[nodiscard]] int stride(std::size_t head) const { return 8 << head; }

  /// px of the input.
  [[nodiscard]] PersonBox box(std::size_t head, std::size_t anchor, cv::Point cell, double confidence) const {
    const auto centre = [&](int index, double logit) {
      return (index + (logistic(logit) - 0.5) * scale_x_y + 0.5) * stride(head);
    };
    const double width = anchors[head][anchor].width * std::exp(growth.x);
    const double height = anchors[head][anchor].height * std::exp(growth.y);
    return {centre(cell.x, offset.x) - width / 2.0, centre(cell.y, offset.y) - height / 2.0, width, height,
            confidence};
  }

  /// A black picture of the input's size whose cell of 8 x 8 px is lit at its middle.
  [[nodiscard]] cv::Mat picture(cv::Point cell, const cv::Vec3b& bgr) const {
    cv::Mat image(input, CV_8UC3, cv::Scalar::all(0.0));
    image.at<cv::Vec3b>(8 * cell.y + 4, 8 * cell.x + 4) = bgr;
    return image;
  }

 private:
  static void append_item(std::string& list, const std::string& item) {
    if (!list.empty()) list += ", ";
    list += item;
  }

  [[nodiscard]] std::string yolo_section(std::size_t head) const {
    std::string mask;
    std::string sides;
    int index = 0;
    for (std::size_t h = 0; h < anchors.size(); ++h) {
      for (const cv::Size2d& anchor : anchors[h]) {
        if (h == head) append_item(mask, std::to_string(index));
        sides +=
            (index == 0 ? "" : ",  ") + std::to_string(anchor.width) + "," + std::to_string(anchor.height);
        ++index;
      }
    }
    return "\n[yolo]\nmask=" + mask + "\nanchors = " + sides + "\nclasses=" + std::to_string(n_classes) +
           "\nnum=" + std::to_string(index) + "\nscale_x_y=" + std::to_string(scale_x_y) + "\n";
  }

  void append_head(std::size_t head, std::vector<float>& all) const {
    constexpr auto kDarkLogit = static_cast<float>(kDark);
    constexpr auto kSlope = static_cast<float>(kLight - kDark);
    const std::vector<double> box_logits{offset.x, offset.y, growth.x, growth.y};
    for (std::size_t anchor = 0; anchor < anchors[head].size(); ++anchor) {
      for (const double logit : box_logits) all.push_back(static_cast<float>(logit));
      all.insert(all.end(), static_cast<std::size_t>(1 + n_classes), kDarkLogit);
    }
    for (std::size_t anchor = 0; anchor < anchors[head].size(); ++anchor) {
      for (int channel = 0; channel < 5 + n_classes; ++channel) {
        for (int colour = 0; colour < 3; ++colour) {  // red, green, blue
          all.push_back(channel == 4 + colour ? kSlope : 0.0F);
        }
      }
    }
  }
};

}  // namespace cpslam
