#include "virtual_camera/film.h"

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "cpslam/error.h"
#include "io/image_reader.h"
#include "io/tum_sequence.h"

namespace cpslam::virtual_camera {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;
constexpr double kMillimetresPerMetre = 1e3;

std::uint64_t to_us(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * kMicrosecondsPerSecond));
}

}  // namespace

Film::Film(const CameraScript& script) : camera_(load_settings(script.settings).camera), fps_(script.fps) {
  for (const RgbdEntry& entry : associate_sequence(script.sequence)) {
    const RgbdImages images = read_rgbd(entry);
    if (!images.error.empty()) throw InputError(images.error);
    Picture picture;
    cv::cvtColor(images.colour, picture.rgb,
                 images.colour.channels() == 1 ? cv::COLOR_GRAY2RGB : cv::COLOR_BGR2RGB);
    images.depth.convertTo(picture.depth_mm, CV_16U, kMillimetresPerMetre / camera_.depth_map_factor);
    pictures_.push_back(std::move(picture));
    times_s_.push_back(images.time_s);
    depth_times_s_.push_back(images.depth_time_s);
  }
  if (pictures_.size() < 2) throw InputError(script.sequence + ": a film needs two pictures");
}

Film::Step Film::step(std::size_t n) const {
  const std::size_t last = pictures_.size() - 1;
  const auto frame = [last](std::size_t i) { return (i / last) % 2 == 0 ? i % last : last - i % last; };
  const std::size_t now = frame(n), next = frame(n + 1);
  const double interval_s = fps_ ? 1.0 / *fps_ : std::abs(times_s_[next] - times_s_[now]);
  const double delay_s = depth_times_s_[now] - times_s_[now];
  return {pictures_[now], std::llround(delay_s * kMicrosecondsPerSecond), to_us(interval_s)};
}

int Film::fps() const {
  return static_cast<int>(std::lround(fps_.value_or(camera_.fps)));
}

}  // namespace cpslam::virtual_camera
