#include "diagnosis/panned_scene.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "util/random.h"

namespace cpslam::diagnosis {
namespace {

constexpr int kMargin = 120;  // px around the middle view

cv::Mat view(const cv::Mat& scene, cv::Point2d at, int interpolation) {
  const cv::Mat where = (cv::Mat_<double>(2, 3) << 1.0, 0.0, kMargin + at.x, 0.0, 1.0, kMargin + at.y);
  cv::Mat result;
  cv::warpAffine(scene, result, where, {PannedScene::kWidth, PannedScene::kHeight},
                 interpolation | cv::WARP_INVERSE_MAP, cv::BORDER_REFLECT);
  return result;
}

}  // namespace

PannedScene::PannedScene(std::uint64_t seed) {
  Random random(seed);
  const cv::Size size(kWidth + 2 * kMargin, kHeight + 2 * kMargin);
  grey_ = cv::Mat(size, CV_8UC1, cv::Scalar(130));
  readings_ = cv::Mat(size, CV_32FC1, cv::Scalar(20000));
  constexpr int kBoxes = 60;
  for (int i = 0; i < kBoxes; ++i) {
    const cv::Point at(static_cast<int>(random.index(static_cast<std::size_t>(size.width))),
                       static_cast<int>(random.index(static_cast<std::size_t>(size.height))));
    const cv::Rect box(
        at, cv::Size(15 + static_cast<int>(random.index(50)), 15 + static_cast<int>(random.index(50))));
    cv::rectangle(grey_, box, cv::Scalar(random.uniform(30.0, 230.0)), cv::FILLED);
    cv::rectangle(readings_, box, cv::Scalar(19000.0 - 250.0 * i), cv::FILLED);
  }
}

cv::Mat PannedScene::grey(cv::Point2d at) const {
  return view(grey_, at, cv::INTER_LINEAR);
}

cv::Mat PannedScene::readings(cv::Point2d at) const {
  return view(readings_, at, cv::INTER_NEAREST);
}

ExaminedFrame PannedScene::frame(double time_s, const Pan& pan, double delay_s) const {
  return {time_s, time_s, grey(pan(time_s)), readings(pan(time_s - delay_s))};
}

cv::Point2d handheld(double time_s) {
  return {25.0 * std::sin(5.0 * time_s) + 6.0 * std::sin(11.0 * time_s), 15.0 * std::sin(7.0 * time_s + 1.0)};
}

}  // namespace cpslam::diagnosis
