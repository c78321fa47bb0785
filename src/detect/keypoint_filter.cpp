#include "detect/keypoint_filter.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detect/depth_grid.h"

namespace cpslam {
namespace {

constexpr float kRimPx = 4.0F;         // a corner on the outline of a person lies on either side of it
constexpr float kWalkingRimPx = 1.5F;  // around who walks, at any depth
constexpr int kNoDepthRimCells = 3;    // the sensor's shadow beside a person has no depth
constexpr int kNoDepthReachCells = 3;  // how far to look for a depth that tells
constexpr int kRestFrames = 90;        // for which the surface must have stayed
constexpr int kPublishedHypotheses = 20;

float same_surface_m(float depth_m) {
  return 0.12F + 0.03F * depth_m;
}

/// Distance (px) of a pixel coordinate from the span of a cell.
float distance_px(float px, int cell) {
  const float first = static_cast<float>(cell * kDepthCellPx) - 0.5F;
  const float last = first + static_cast<float>(kDepthCellPx);
  return std::max({first - px, px - last, 0.0F});
}

class Judge {
 public:
  Judge(const GridCamera& camera, const cv::Mat1f& depth_m, const std::vector<PersonTrack>& tracks,
        double depth_lag_s)
      : depth_m_(depth_m),
        tracks_(tracks),
        people_(depth_m.size(), std::uint8_t{0}),
        guessed_(depth_m.size(), std::uint8_t{0}),
        people_m_(depth_m.size(), 0.0F) {
    for (const PersonTrack& track : tracks) {
      const bool walks = is_walking(track);
      for (std::size_t i = 0; i < track.visible.size(); ++i) {
        const int cell = track.visible.cells[i];
        const float depth = track.visible.depth_m[i];
        enter(cell, depth, walks);
        if (!track.shown) guessed_(cell) = 1;
        if (!walks || depth_lag_s == 0.0) continue;
        const Eigen::Vector3f gone_on =
            camera.point(cell, depth) + track.velocity_m_per_s * static_cast<float>(depth_lag_s);
        if (const int there = camera.cell_of(gone_on); there >= 0) enter(there, gone_on.z(), walks);
      }
    }
  }

  [[nodiscard]] bool on_person(const DepthKeypoint& k) const {
    const cv::Point cell(static_cast<int>((k.x + 0.5F) / static_cast<float>(kDepthCellPx)),
                         static_cast<int>((k.y + 0.5F) / static_cast<float>(kDepthCellPx)));
    return k.depth_m > 0.0F ? on_surface(k, cell) : hidden_in_person(k, cell);
  }

 private:
  static constexpr std::uint8_t kNobody = 0;
  static constexpr std::uint8_t kStanding = 1;
  static constexpr std::uint8_t kWalking = 2;

  void enter(int cell, float depth_m, bool walks) {
    people_(cell) = walks ? kWalking : kStanding;
    people_m_(cell) = depth_m;
  }

  [[nodiscard]] bool on_surface(const DepthKeypoint& k, cv::Point cell) const {
    const cv::Rect around = cv::Rect(cell.x - 1, cell.y - 1, 3, 3) & cv::Rect({}, people_.size());
    for (int y = around.y; y < around.br().y; ++y) {
      for (int x = around.x; x < around.br().x; ++x) {
        if (people_(y, x) == kNobody) continue;
        const float away_px = std::hypot(distance_px(k.x, x), distance_px(k.y, y));
        if (people_(y, x) == kWalking && away_px <= kWalkingRimPx) return true;
        if (away_px <= kRimPx && std::abs(k.depth_m - people_m_(y, x)) <= same_surface_m(k.depth_m))
          return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool hidden_in_person(const DepthKeypoint& k, cv::Point cell) const {
    const cv::Rect grid({}, people_.size());
    const auto square = [&](int reach) {
      return cv::Rect(cell.x - reach, cell.y - reach, 2 * reach + 1, 2 * reach + 1) & grid;
    };
    const cv::Rect beside = square(kNoDepthRimCells);
    if (cv::countNonZero(people_(beside)) > 0)
      return cv::countNonZero(guessed_(beside)) > 0 || !in_shadow(cell);
    if (cv::countNonZero(depth_m_(square(kNoDepthReachCells))) > 0) return false;
    return std::any_of(tracks_.begin(), tracks_.end(),
                       [&k](const PersonTrack& t) { return contains(t.box, k); });
  }

  enum class Reading { kNone, kPerson, kOther };

  /// The first that is met on the way from a cell.
  [[nodiscard]] Reading first_reading(cv::Point cell, cv::Point step) const {
    for (const cv::Rect grid({}, people_.size()); grid.contains(cell); cell += step) {
      if (people_(cell) != kNobody) return Reading::kPerson;
      if (depth_m_(cell) > 0.0F) return Reading::kOther;
    }
    return Reading::kNone;
  }

  /// Whether a cell without depth lies between a person and what is behind him. Projector and camera are side
  /// by side, and so are a person and his shadow; hair has no depth either, but the person goes on below.
  [[nodiscard]] bool in_shadow(cv::Point cell) const {
    const bool left = first_reading(cell, {-1, 0}) == Reading::kPerson;
    const bool right = first_reading(cell, {1, 0}) == Reading::kPerson;
    const bool inside =
        first_reading(cell, {0, -1}) == Reading::kPerson && first_reading(cell, {0, 1}) == Reading::kPerson;
    return left != right && !inside;
  }

  const cv::Mat1f& depth_m_;
  const std::vector<PersonTrack>& tracks_;
  cv::Mat1b people_;   // kNobody, kStanding or kWalking
  cv::Mat1b guessed_;  // non-zero: carried there, not shown by this frame's boxes
  cv::Mat1f people_m_;
};

/// Marks the person's keypoints among `members` of one box.
void mark_as_published(std::span<const DepthKeypoint> keypoints, const std::vector<std::size_t>& members,
                       Random& random, std::vector<std::uint8_t>& marks) {
  if (members.size() < 2) {
    for (const std::size_t i : members) marks[i] = 1;
    return;
  }
  std::vector<std::size_t> best;
  float best_likelihood = -1.0F;
  for (int k = 0; k < kPublishedHypotheses; ++k) {
    const float a = keypoints[members[random.index(members.size())]].depth_m;
    const float b = keypoints[members[random.index(members.size())]].depth_m;
    const float mean = 0.5F * (a + b);                            // (3)
    const float sigma = std::max(0.5F * std::abs(a - b), 1e-3F);  // (4)
    const float share = static_cast<float>(best.size()) / static_cast<float>(members.size());
    const float threshold_m = 0.02F * (1.0F + share);  // (6)
    std::vector<std::size_t> inliers;
    float likelihood = 0.0F;
    for (const std::size_t i : members) {
      const float off = std::abs(keypoints[i].depth_m - mean);
      if (off >= threshold_m) continue;
      inliers.push_back(i);
      likelihood += std::exp(-0.5F * off * off / (sigma * sigma)) / (2.5066283F * sigma);  // (5)
    }
    if (inliers.size() < best.size() || (inliers.size() == best.size() && likelihood <= best_likelihood))
      continue;
    best = std::move(inliers);
    best_likelihood = likelihood;
  }
  for (const std::size_t i : best) marks[i] = 1;
}

}  // namespace

std::vector<std::uint8_t> find_keypoints_on_people(const GridCamera& camera, const cv::Mat1f& depth_m,
                                                   const std::vector<PersonTrack>& tracks, double depth_lag_s,
                                                   std::span<const DepthKeypoint> keypoints) {
  std::vector<std::uint8_t> marks(keypoints.size(), 0);
  if (tracks.empty()) return marks;
  const Judge judge(camera, depth_m, tracks, depth_lag_s);
  std::transform(keypoints.begin(), keypoints.end(), marks.begin(),
                 [&judge](const DepthKeypoint& k) { return static_cast<std::uint8_t>(judge.on_person(k)); });
  return marks;
}

std::vector<std::uint8_t> find_keypoints_on_resting_people(const GridCamera& camera,
                                                           const cv::Mat1b& still_age,
                                                           const std::vector<PersonTrack>& tracks,
                                                           std::span<const DepthKeypoint> keypoints) {
  cv::Mat1b resting(camera.size(), std::uint8_t{0});
  cv::Mat1b restless(camera.size(), std::uint8_t{0});
  for (const PersonTrack& track : tracks) {
    const bool rests = is_resting(track);
    for (const int cell : track.visible.cells) {
      const bool cell_rests = rests && still_age(cell) >= kRestFrames;
      (cell_rests ? resting : restless)(cell) = 1;
    }
  }
  cv::dilate(resting, resting, cv::Mat());
  cv::dilate(restless, restless, cv::Mat());
  std::vector<std::uint8_t> marks(keypoints.size(), 0);
  std::transform(keypoints.begin(), keypoints.end(), marks.begin(), [&](const DepthKeypoint& k) {
    const int cell = k.depth_m > 0.0F ? camera.cell_of_pixel(k.x, k.y) : -1;
    return static_cast<std::uint8_t>(cell >= 0 && resting(cell) != 0 && restless(cell) == 0);
  });
  return marks;
}

std::vector<std::uint8_t> find_keypoints_in_boxes(std::span<const PersonBox> boxes,
                                                  std::span<const DepthKeypoint> keypoints) {
  std::vector<std::uint8_t> marks(keypoints.size(), 0);
  std::transform(keypoints.begin(), keypoints.end(), marks.begin(), [boxes](const DepthKeypoint& k) {
    return static_cast<std::uint8_t>(
        std::any_of(boxes.begin(), boxes.end(), [&k](const PersonBox& box) { return contains(box, k); }));
  });
  return marks;
}

std::vector<std::uint8_t> find_keypoints_as_published(std::span<const PersonBox> boxes,
                                                      std::span<const DepthKeypoint> keypoints,
                                                      Random& random) {
  std::vector<std::uint8_t> marks(keypoints.size(), 0);
  for (const PersonBox& box : boxes) {
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      if (keypoints[i].depth_m > 0.0F && contains(box, keypoints[i])) members.push_back(i);
    }
    mark_as_published(keypoints, members, random, marks);
  }
  return marks;
}

}  // namespace cpslam
