#include "openni/frame_pairer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cpslam {
namespace {

/// Pictures of a kind that may wait. One stream may be some pictures ahead of the other.
constexpr std::size_t kMaxWaiting = 4;

std::uint64_t distance_us(std::uint64_t a, std::uint64_t b) {
  return a > b ? a - b : b - a;
}

}  // namespace

double pair_tolerance_s(double frames_per_s) {
  return std::min(0.5 / frames_per_s, 0.02);
}

FramePairer::FramePairer(double tolerance_s)
    : tolerance_us_(static_cast<std::uint64_t>(std::llround(1e6 * tolerance_s))) {}

std::optional<CameraFrame> FramePairer::add_colour(CameraPicture picture) {
  if (std::optional<CameraPicture> depth = take_partner(depths_, picture.time_us)) {
    unpaired_ += std::exchange(colours_, {}).size();  // they came before, and so would their depths have
    return CameraFrame{std::move(picture), std::move(*depth)};
  }
  colours_.push_back(std::move(picture));
  if (colours_.size() > kMaxWaiting) {
    colours_.pop_front();
    ++unpaired_;
  }
  return std::nullopt;
}

std::optional<CameraFrame> FramePairer::add_depth(CameraPicture picture) {
  const std::size_t waiting = colours_.size();
  if (std::optional<CameraPicture> colour = take_partner(colours_, picture.time_us)) {
    unpaired_ += waiting - colours_.size() - 1;
    depths_.clear();
    return CameraFrame{std::move(*colour), std::move(picture)};
  }
  depths_.push_back(std::move(picture));
  if (depths_.size() > kMaxWaiting) depths_.pop_front();
  return std::nullopt;
}

std::optional<CameraPicture> FramePairer::take_partner(std::deque<CameraPicture>& queue,
                                                       std::uint64_t time_us) {
  const auto nearest = std::min_element(queue.begin(), queue.end(), [time_us](const auto& a, const auto& b) {
    return distance_us(a.time_us, time_us) < distance_us(b.time_us, time_us);
  });
  if (nearest == queue.end() || distance_us(nearest->time_us, time_us) >= tolerance_us_) return std::nullopt;
  CameraPicture partner = std::move(*nearest);
  queue.erase(queue.begin(), std::next(nearest));
  return partner;
}

}  // namespace cpslam
