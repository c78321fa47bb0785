#include "detect/person_carry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "detect/grid_cells.h"
#include "detect/still_surface.h"
#include "util/median.h"

namespace cpslam {
namespace {

// Before and behind his middle, where nothing has arrived: no walking over the floor.
constexpr float kBodyM = 0.35F;
constexpr int kGrowthCells = 3;        // an outline moves no further between two frames, once carried
constexpr int kLateGrowthCells = 12;   // a torso comes into view beside the legs that are known
constexpr float kFoundShare = 0.3F;    // of the predicted surface: less, and something hides the person
constexpr float kDepthShiftM = 0.02F;  // uncertainty of the median between found and predicted depths
constexpr std::size_t kMinCells = 6;
constexpr double kMaxStepS = 0.5;  // velocities predict nothing over a longer gap

/// How far the depth of a moving person may be from where his velocity puts it.
float agreement_m(float depth_m, double dt_s) {
  return 0.06F + 0.02F * depth_m + 0.5F * static_cast<float>(dt_s);
}

/// What the previous frame says about this one.
struct Prediction {
  explicit Prediction(cv::Size size) : person(size, std::uint8_t{0}), person_m(size, 0.0F) {}
  cv::Mat1b person;  // index of the track + 1
  cv::Mat1f person_m;
};

GridSurface move_surface(const GridCamera& camera, const FloatTransform& move, const Eigen::Vector3f& offset,
                         const GridSurface& surface) {
  GridSurface moved;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f point = move * camera.point(surface.cells[i], surface.depth_m[i]) + offset;
    if (const int there = camera.cell_of(point); there >= 0) moved.add(there, point.z());
  }
  return moved;
}

float mean_depth_m(const GridSurface& surface) {
  if (surface.size() == 0) return 0.0F;
  return std::accumulate(surface.depth_m.begin(), surface.depth_m.end(), 0.0F) /
         static_cast<float>(surface.size());
}

/// How far a surface moves in the image, on average. Not from cell to cell: a person moves by less than one.
Eigen::Vector2f mean_shift_px(const GridCamera& camera, const FloatTransform& move,
                              const Eigen::Vector3f& offset, const GridSurface& surface) {
  const Eigen::Vector2f scale(static_cast<float>(camera.camera().fx()),
                              static_cast<float>(camera.camera().fy()));
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  int n = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Eigen::Vector3f before = camera.point(surface.cells[i], surface.depth_m[i]);
    const Eigen::Vector3f after = move * before + offset;
    if (camera.cell_of(after) < 0) continue;
    sum += after.head<2>() / after.z() - before.head<2>() / before.z();
    ++n;
  }
  return sum.cwiseProduct(scale) / static_cast<float>(std::max(1, n));
}

void carry_box(const GridSurface& before, const GridSurface& after, const Eigen::Vector2f& shift_px,
               PersonBox& box) {
  if (before.size() < kMinCells || after.size() < kMinCells) return;
  const auto scale = static_cast<double>(mean_depth_m(before) / mean_depth_m(after));
  const double x = box.x + 0.5 * box.width + static_cast<double>(shift_px.x());
  const double y = box.y + 0.5 * box.height + static_cast<double>(shift_px.y());
  box.width *= scale;
  box.height *= scale;
  box.x = x - 0.5 * box.width;
  box.y = y - 0.5 * box.height;
}

/// Finds one person after the other in the new depths.
class Finder {
 public:
  Finder(const FrameStep& step, const Prediction& prediction)
      : step_(step), prediction_(prediction), taken_(step.depth_m.size(), std::uint8_t{0}) {}

  /// late: no box has shown him in the frame before.
  GridSurface find(std::uint8_t index, const GridSurface& predicted, int recent_age, bool late) {
    found_.clear();
    recent_age_ = recent_age;
    for (const int cell : predicted.cells) {
      if (prediction_.person(cell) == index && taken_(cell) == 0 && agrees(cell)) take(cell);
    }
    n_agreeing_ = found_.size();
    mean_m_ = mean_depth_m(found_);
    std::size_t begin = 0;
    for (int round = 0; round < (late ? kLateGrowthCells : kGrowthCells); ++round) {
      const std::size_t end = found_.size();
      for (std::size_t i = begin; i < end; ++i) grow_from(found_.cells[i], index, round < kGrowthCells);
      begin = end;
    }
    return found_;
  }
  [[nodiscard]] std::size_t n_agreeing() const { return n_agreeing_; }

 private:
  [[nodiscard]] bool agrees(int cell) const {
    const float depth_m = step_.depth_m(cell);
    if (depth_m <= 0.0F) return false;
    if (is_still(cell)) return false;
    return std::abs(depth_m - prediction_.person_m(cell)) < agreement_m(depth_m, step_.dt_s);
  }
  [[nodiscard]] bool is_still(int cell) const {
    return step_.still.free_age(cell) >= StillSurface::kStillAge;
  }
  [[nodiscard]] bool is_recent(int cell) const { return step_.still.free_age(cell) <= recent_age_; }
  [[nodiscard]] bool has_arrived(int cell) const {
    return step_.still.free_age(cell) < StillSurface::kUnknownAge;
  }
  void take(int cell) {
    taken_(cell) = 1;
    found_.add(cell, step_.depth_m(cell));
  }
  /// anywhere: also where the camera sees what it did not see before, not only where something has changed.
  void grow_from(int cell, std::uint8_t index, bool anywhere) {
    const int columns = step_.depth_m.cols;
    for (const cv::Point& next : neighbours({cell % columns, cell / columns})) {
      if (!cv::Rect({}, step_.depth_m.size()).contains(next) || taken_(next) != 0) continue;
      const int there = next.y * columns + next.x;
      const float depth_m = step_.depth_m(next);
      const float fold_m = has_arrived(there) ? kFoldM : 0.0F;
      if (depth_m <= 0.0F || std::abs(depth_m - step_.depth_m(cell)) > connected_step_m(depth_m) + fold_m)
        continue;
      const std::uint8_t other = prediction_.person(next);
      if ((other != 0 && other != index) || !is_recent(there)) continue;
      if (!anywhere && step_.still.changed(there) == 0) continue;
      if (!has_arrived(there) && std::abs(depth_m - mean_m_) > kBodyM) continue;
      take(there);
    }
  }

  const FrameStep& step_;
  const Prediction& prediction_;
  cv::Mat1b taken_;
  GridSurface found_;
  std::size_t n_agreeing_ = 0;
  int recent_age_ = 0;   // up to which a surface may be his
  float mean_m_ = 0.0F;  // depth of the person at hand
};

void enter_people(const std::vector<GridSurface>& moved, Prediction& prediction) {
  for (std::size_t t = 0; t < moved.size(); ++t) {
    for (std::size_t i = 0; i < moved[t].size(); ++i) {
      const int cell = moved[t].cells[i];
      float& known_m = prediction.person_m(cell);
      if (known_m > 0.0F && known_m <= moved[t].depth_m[i]) continue;
      known_m = moved[t].depth_m[i];
      prediction.person(cell) = static_cast<std::uint8_t>(t + 1);
    }
  }
}

/// The part of a predicted surface that something nearer hides: it is carried on unseen.
GridSurface hidden_part(const FrameStep& step, const GridSurface& moved) {
  GridSurface hidden;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const float depth_m = step.depth_m(moved.cells[i]);
    if (depth_m > 0.0F && depth_m < moved.depth_m[i] - agreement_m(moved.depth_m[i], step.dt_s))
      hidden.add(moved.cells[i], moved.depth_m[i]);
  }
  return hidden;
}

void settle(const FrameStep& step, const GridSurface& moved, GridSurface found, std::size_t n_agreeing,
            const Prediction& prediction, PersonTrack& track) {
  const GridSurface hidden = hidden_part(step, moved);
  const auto expected = static_cast<float>(moved.size() - hidden.size());
  const bool seen = found.size() >= kMinCells && static_cast<float>(n_agreeing) >= kFoundShare * expected;
  track.visible = std::move(found);
  if (!seen) {
    track.shape = moved;
    return;
  }
  track.seen_s = step.time_s;
  if (step.dt_s > 0.0 && n_agreeing >= kMinCells) {
    std::vector<float> off;
    off.reserve(n_agreeing);
    for (std::size_t i = 0; i < n_agreeing; ++i) {
      const int cell = track.visible.cells[i];
      off.push_back(step.depth_m(cell) - prediction.person_m(cell));
    }
    const float shift_m = median(off);
    const float sigma = kDepthShiftM / static_cast<float>(step.dt_s);
    Eigen::Vector3f measured = track.velocity_m_per_s;
    measured.z() += shift_m / static_cast<float>(step.dt_s);
    constexpr float kUnmeasured = 1e3F;
    measure_velocity(measured, {kUnmeasured, kUnmeasured, sigma}, track);
  }
  track.shape = track.visible;
  for (std::size_t i = 0; i < hidden.size(); ++i) track.shape.add(hidden.cells[i], hidden.depth_m[i]);
}

}  // namespace

void carry_people(const GridCamera& camera, const FrameStep& step, std::vector<PersonTrack>& tracks) {
  if (tracks.empty()) return;
  const cv::Size size = step.depth_m.size();
  Prediction prediction(size);

  const FloatTransform move(step.this_from_previous);
  std::vector<GridSurface> moved;
  for (PersonTrack& track : tracks) {
    track.velocity_m_per_s = move.rotation * track.velocity_m_per_s;
    age_velocity(step.dt_s, track);
    const auto dt_s = static_cast<float>(std::min(step.dt_s, kMaxStepS));
    const Eigen::Vector3f offset = track.velocity_m_per_s * dt_s;
    moved.push_back(move_surface(camera, move, offset, track.shape));
    carry_box(track.shape, moved.back(), mean_shift_px(camera, move, offset, track.shape), track.box);
  }
  enter_people(moved, prediction);

  std::vector<std::size_t> nearest_first(tracks.size());
  std::iota(nearest_first.begin(), nearest_first.end(), std::size_t{0});
  std::stable_sort(nearest_first.begin(), nearest_first.end(), [&](std::size_t a, std::size_t b) {
    return mean_depth_m(moved[a]) < mean_depth_m(moved[b]);
  });
  Finder finder(step, prediction);
  for (const std::size_t t : nearest_first) {
    const int recent_age =
        std::max<int>(StillSurface::kRecentAge, passing_frames(tracks[t], std::max(step.dt_s, 1e-3)));
    const bool late = !tracks[t].shown;
    tracks[t].shown = false;
    GridSurface found = finder.find(static_cast<std::uint8_t>(t + 1), moved[t], recent_age, late);
    settle(step, moved[t], std::move(found), finder.n_agreeing(), prediction, tracks[t]);
  }
}

}  // namespace cpslam
