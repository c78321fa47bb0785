#include "diagnosis/delay_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cpslam::diagnosis {
namespace {

constexpr int kSteps = 50;  // to either side
constexpr double kStep_s = 0.005;
constexpr std::size_t kFewestFrames = 24;
constexpr std::size_t kGroups = 8;  // of the jackknife

double delay_of(int step) {
  return kStep_s * (step - kSteps);
}

/// Height of the best agreement by delay.
using Profile = std::array<double, 2 * kSteps + 1>;

/// The maps of a group of frames summed up, for every delay.
class DelayStack {
 public:
  explicit DelayStack(int range_px) : maps_(2 * kSteps + 1, AgreementMap(range_px)) {}

  /// Adds a frame, its edges moved back by what each delay explains; false when the motion is not known.
  bool add(const FrameAgreement& frame, const ImageMotion& motion) {
    std::vector<cv::Point> offsets;
    for (int i = 0; i <= 2 * kSteps; ++i) {
      const auto moved = motion.between(frame.depth_time_s - delay_of(i), frame.colour_time_s);
      if (!moved) return false;
      offsets.emplace_back(static_cast<int>(std::lround(-moved->x)),
                           static_cast<int>(std::lround(-moved->y)));
    }
    for (std::size_t i = 0; i < maps_.size(); ++i) maps_[i].add_moved(frame.map, offsets[i]);
    return true;
  }
  void add(const DelayStack& other) {
    for (std::size_t i = 0; i < maps_.size(); ++i) maps_[i].add(other.maps_[i]);
  }
  void subtract(const DelayStack& other) {
    for (std::size_t i = 0; i < maps_.size(); ++i) maps_[i].subtract(other.maps_[i]);
  }
  [[nodiscard]] Profile profile() const {
    Profile heights{};
    for (std::size_t i = 0; i < maps_.size(); ++i) heights[i] = maps_[i].highest();
    return heights;
  }
  [[nodiscard]] const AgreementMap& map(int step) const { return maps_[static_cast<std::size_t>(step)]; }

 private:
  std::vector<AgreementMap> maps_;  // by delay
};

constexpr int kReach = 6;  // steps to either side of the highest: a frame

/// Whether the profile falls to both sides of a step. Of an even motion one delay is as good as another,
/// with another shift: it does not.
bool is_top(const Profile& profile, int step) {
  constexpr double kLeastFall = 0.03;  // as a share
  const auto at = [&profile](int i) { return profile[static_cast<std::size_t>(i)]; };
  if (step < kReach || step > 2 * kSteps - kReach) return false;
  return std::max(at(step - kReach), at(step + kReach)) < (1.0 - kLeastFall) * at(step);
}

/// The delay at the top of a parabola fitted to the profile around its highest value; empty when it has no
/// clear top.
std::optional<double> top_of(const Profile& profile) {
  const int highest = static_cast<int>(std::max_element(profile.begin(), profile.end()) - profile.begin());
  if (!is_top(profile, highest)) return std::nullopt;
  double x2 = 0.0, x4 = 0.0, y = 0.0, xy = 0.0, x2y = 0.0;
  for (int x = -kReach; x <= kReach; ++x) {
    const double value = profile[static_cast<std::size_t>(highest + x)];
    x2 += x * x;
    x4 += x * x * x * x;
    y += value;
    xy += x * value;
    x2y += x * x * value;
  }
  const double n = 2.0 * kReach + 1.0;
  const double bend = (n * x2y - x2 * y) / (n * x4 - x2 * x2);
  if (bend >= 0.0) return std::nullopt;
  const double top = -0.5 * (xy / x2) / bend;
  return std::abs(top) <= kReach ? std::optional(delay_of(highest) + top * kStep_s) : std::nullopt;
}

/// Groups of frames that follow each other, so that what they have in common counts as one.
std::vector<DelayStack> stack_groups(const std::vector<FrameAgreement>& frames, const ImageMotion& motion) {
  std::vector<DelayStack> groups(kGroups, DelayStack(frames.front().map.range_px()));
  std::size_t n_used = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (groups[i * kGroups / frames.size()].add(frames[i], motion)) ++n_used;
  }
  if (n_used < kFewestFrames) groups.clear();
  return groups;
}

}  // namespace

std::optional<DepthDelay> find_depth_delay(const std::vector<FrameAgreement>& frames,
                                           const ImageMotion& colour_motion) {
  if (frames.size() < kFewestFrames) return std::nullopt;
  const std::vector<DelayStack> groups = stack_groups(frames, colour_motion);
  if (groups.empty()) return std::nullopt;
  DelayStack all(frames.front().map.range_px());
  for (const DelayStack& group : groups) all.add(group);
  const std::optional<double> best = top_of(all.profile());
  if (!best) return std::nullopt;
  double square_sum = 0.0;
  for (const DelayStack& group : groups) {
    DelayStack others = all;
    others.subtract(group);
    const std::optional<double> without = top_of(others.profile());
    if (!without) return std::nullopt;
    square_sum += (*without - *best) * (*without - *best);
  }
  const auto peak = all.map(kSteps + static_cast<int>(std::lround(*best / kStep_s))).peak();
  if (!peak) return std::nullopt;
  return DepthDelay{*best, std::sqrt(square_sum * (kGroups - 1.0) / kGroups), *peak};
}

}  // namespace cpslam::diagnosis
