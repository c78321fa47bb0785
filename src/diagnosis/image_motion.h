#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace cpslam::diagnosis {

/// Follows the motion of a whole stream of colour pictures, by phase correlation (Kuglin and Hines 1975) of
/// each with the one before.
class ImageMotion {
 public:
  /// grey: CV_8UC1, always of one size. Pictures that come more than 0.25 s after the one before, or not
  /// after it, begin a new stretch.
  void add(double time_s, const cv::Mat& grey);

  /// How far the picture's content moves from one time to another, px; between pictures by cubic
  /// interpolation. Empty unless both times lie in one stretch.
  [[nodiscard]] std::optional<cv::Point2d> between(double from_s, double to_s) const;

 private:
  struct Knot {
    double time_s;
    cv::Point2d at_px;  // since the stretch began
    int stretch;
  };

  [[nodiscard]] bool is_inside(std::size_t knot) const;
  [[nodiscard]] std::optional<std::size_t> knot_after(double time_s) const;
  [[nodiscard]] cv::Point2d slope(std::size_t from, std::size_t to) const;
  [[nodiscard]] cv::Point2d slope_at(std::size_t knot, std::size_t piece_end) const;
  [[nodiscard]] cv::Point2d at(std::size_t knot, double time_s) const;

  cv::Mat window_;  // fades the picture's border out
  cv::Mat last_;    // the picture before, reduced
  std::vector<Knot> knots_;
};

}  // namespace cpslam::diagnosis
