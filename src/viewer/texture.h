#pragma once

#include <opencv2/core/mat.hpp>

namespace cpslam::viewer {

/// A picture in the graphics card's memory. Lives in the thread of its OpenGL context.
class Texture {
 public:
  Texture();
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// CV_8UC1 (shown grey), CV_8UC3 (B,G,R) or CV_8UC4 (R,G,B,A); an empty one empties the texture.
  void set(const cv::Mat& picture);
  [[nodiscard]] bool empty() const { return size_.area() == 0; }
  [[nodiscard]] cv::Size size() const { return size_; }
  /// For ImGui::Image.
  [[nodiscard]] void* handle() const;

 private:
  unsigned id_ = 0;
  cv::Size size_;
};

}  // namespace cpslam::viewer
