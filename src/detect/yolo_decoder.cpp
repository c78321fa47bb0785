#include "detect/yolo_decoder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <optional>

namespace cpslam {
namespace {

constexpr int kFirstClass = 5;

struct Span {
  double begin;
  double end;
};

/// One axis of a box, px; empty when it does not touch [0, side].
std::optional<Span> span_on(double centre_share, double side_share, int side) {
  const double begin = (centre_share - side_share / 2.0) * side;
  const double end = (centre_share + side_share / 2.0) * side;
  if (!std::isfinite(begin) || !std::isfinite(end) || !(end > begin)) return std::nullopt;
  if (end <= 0.0 || begin >= side) return std::nullopt;
  return Span{std::max(begin, -1.0 * side), std::min(end, 2.0 * side)};
}

float best_score(const float* row, const std::vector<int>& classes) {
  float best = 0.0F;
  for (const int index : classes) best = std::max(best, row[kFirstClass + index]);
  return best;
}

}  // namespace

std::vector<PersonBox> decode_yolo(const std::vector<cv::Mat>& outputs, cv::Size input,
                                   const std::vector<int>& classes, const YoloThresholds& thresholds) {
  std::vector<cv::Rect2d> boxes;
  std::vector<float> scores;
  for (const cv::Mat& output : outputs) {
    for (int r = 0; r < output.rows; ++r) {
      const float* const row = output.ptr<float>(r);
      const float score = best_score(row, classes);
      if (!(score >= static_cast<float>(thresholds.confidence))) continue;
      const std::optional<Span> x = span_on(row[0], row[2], input.width);
      const std::optional<Span> y = span_on(row[1], row[3], input.height);
      if (!x || !y) continue;
      boxes.emplace_back(x->begin, y->begin, x->end - x->begin, y->end - y->begin);
      scores.push_back(std::min(score, 1.0F));
    }
  }
  std::vector<int> kept;
  cv::dnn::NMSBoxes(boxes, scores, 0.0F, static_cast<float>(thresholds.overlap), kept);
  std::vector<PersonBox> people;
  for (const int k : kept) {
    const auto i = static_cast<std::size_t>(k);
    people.push_back({boxes[i].x, boxes[i].y, boxes[i].width, boxes[i].height, scores[i]});
  }
  return people;
}

}  // namespace cpslam
