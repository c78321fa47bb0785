#include "diagnosis/image_motion.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace cpslam::diagnosis {
namespace {

constexpr double kLongestInterval_s = 0.25;
constexpr int kReducedWidth = 160;  // px

}  // namespace

void ImageMotion::add(double time_s, const cv::Mat& grey) {
  const double scale = std::max(1.0, static_cast<double>(grey.cols) / kReducedWidth);
  cv::Mat reduced;
  cv::resize(grey, reduced, {}, 1.0 / scale, 1.0 / scale, cv::INTER_AREA);
  reduced.convertTo(reduced, CV_32F);
  if (window_.empty()) cv::createHanningWindow(window_, reduced.size(), CV_32F);
  const bool follows =
      !knots_.empty() && time_s > knots_.back().time_s && time_s - knots_.back().time_s <= kLongestInterval_s;
  if (follows) {
    const cv::Point2d moved = scale * cv::phaseCorrelate(last_, reduced, window_);
    knots_.push_back({time_s, knots_.back().at_px + moved, knots_.back().stretch});
  } else {
    knots_.push_back({time_s, {0.0, 0.0}, knots_.empty() ? 0 : knots_.back().stretch + 1});
  }
  last_ = reduced;
}

/// Whether the piece that ends at this knot is one of a stretch.
bool ImageMotion::is_inside(std::size_t knot) const {
  return knot > 0 && knot < knots_.size() && knots_[knot].stretch == knots_[knot - 1].stretch;
}

/// The end of the piece that a time lies in.
std::optional<std::size_t> ImageMotion::knot_after(double time_s) const {
  const auto by_time = [](const Knot& knot, double t) { return knot.time_s < t; };
  const auto found = std::lower_bound(knots_.begin(), knots_.end(), time_s, by_time);
  auto knot = static_cast<std::size_t>(found - knots_.begin());
  if (!is_inside(knot) && knot < knots_.size() && knots_[knot].time_s == time_s) ++knot;  // a stretch's first
  return is_inside(knot) ? std::optional(knot) : std::nullopt;
}

cv::Point2d ImageMotion::slope(std::size_t from, std::size_t to) const {
  return (knots_[to].at_px - knots_[from].at_px) / (knots_[to].time_s - knots_[from].time_s);
}

cv::Point2d ImageMotion::slope_at(std::size_t knot, std::size_t piece_end) const {
  if (is_inside(knot) && is_inside(knot + 1)) return slope(knot - 1, knot + 1);
  return slope(piece_end - 1, piece_end);
}

/// Cubic Hermite interpolation: the speed is continuous, as a camera's is.
cv::Point2d ImageMotion::at(std::size_t knot, double time_s) const {
  const Knot &a = knots_[knot - 1], &b = knots_[knot];
  const double h = b.time_s - a.time_s, u = (time_s - a.time_s) / h, v = 1.0 - u;
  return v * v * (1.0 + 2.0 * u) * a.at_px + u * u * (1.0 + 2.0 * v) * b.at_px +
         u * v * h * (v * slope_at(knot - 1, knot) - u * slope_at(knot, knot));
}

std::optional<cv::Point2d> ImageMotion::between(double from_s, double to_s) const {
  const std::optional<std::size_t> from = knot_after(from_s), to = knot_after(to_s);
  if (!from || !to || knots_[*from].stretch != knots_[*to].stretch) return std::nullopt;
  return at(*to, to_s) - at(*from, from_s);
}

}  // namespace cpslam::diagnosis
