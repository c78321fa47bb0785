#include "detect/person_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "detect/background_planes.h"
#include "detect/depth_grid.h"
#include "detect/grid_cells.h"
#include "detect/person_growth.h"
#include "detect/place_prior.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

constexpr int kMaxGridSamples = 400;
constexpr int kMaxSurfaces = 3;       // candidates for the person in a box
constexpr float kMinShare = 0.08F;    // of the samples, to be one
constexpr float kGoodMatch = 0.6F;    // of a surface's outline with the box: no need to look for another
constexpr float kKnownWeight = 3.0F;  // of the depths of people carried into the frame
constexpr float kStillWeight = 0.3F;  // of surfaces that have not moved
constexpr float kKnownGain = 2.0F;
constexpr float kMostlyKnown = 0.5F;
constexpr float kStillCost = 0.5F;
constexpr float kLeakCost = 3.0F;      // of an outline that goes on outside the box
constexpr float kOverlapShare = 0.5F;  // of a fit: then it is the other one's person

/// One call of fit_people: the grid, and what is taken by the people found so far.
class Fitter {
 public:
  Fitter(const GridCamera& camera, const SceneEvidence& scene, std::span<const DepthKeypoint> keypoints,
         Random& random)
      : camera_(camera),
        scene_(scene),
        depth_m_(scene.depth_m),
        keypoints_(keypoints),
        random_(random),
        taken_(scene.depth_m.size(), std::uint8_t{0}),
        growth_(scene, taken_) {}

  /// The surface whose outline fits the box best: a detector draws its box round the person, while a wall
  /// goes on behind the box and a monitor in front of him ends inside it.
  PersonFit fit(const KnownBox& known_box) {
    const PersonBox& box = known_box.box;
    PersonFit best;
    const cv::Rect area = cells_of_box(camera_, box);
    if (area.empty()) return best;
    const PlacePrior prior(box, camera_.image_size());
    std::vector<DepthSample> samples = gather_samples(known_box, area, prior);
    const std::vector<GridPlane> background = find_background_planes(depth_m_, area, random_);
    float best_score = 0.0F;
    float left = 1.0F;  // share of the samples that no surface has explained
    for (int i = 0; i < kMaxSurfaces && left > kMinShare; ++i) {
      PersonFit candidate;
      candidate.model = fit_sdf_model(samples, random_);
      const float share = candidate.model.share * left;
      if (!candidate.model.valid() || (share < kMinShare && i > 0)) break;
      GrownSurface surface = growth_.grow(candidate.model, area, prior, background, known_box);
      candidate.cells = std::move(surface.cells);
      candidate.front = std::move(surface.front);
      candidate.match = outline_match(candidate.cells, depth_m_.cols, area) *
                        std::max(0.0F, 1.0F - kLeakCost * surface.leak);
      const float known = share_of(candidate.cells, [&](int cell) {
        return known_box.number != 0 && scene_.people(cell) == known_box.number;
      });
      const float still = share_of(candidate.cells, [this](int cell) {
        return scene_.still.free_age(cell) >= StillSurface::kStillAge;
      });
      const float score =
          candidate.match * std::sqrt(share) * (1.0F + kKnownGain * known) * (1.0F - kStillCost * still);
      if (score > best_score) {
        best_score = score;
        best = candidate;
      }
      if (candidate.match > kGoodMatch && known > kMostlyKnown) break;
      std::erase_if(samples, [&](const DepthSample& s) { return candidate.model.contains(s.depth_m); });
      left -= share;
    }
    return best;
  }

  /// What is in front of him stays free: another box may show whose it is.
  void take(const PersonFit& fit) {
    for (const int cell : fit.cells) {
      if (!is_in_front(fit, cell)) taken_(cell) = 1;
    }
  }
  /// Takes from somebody what is in front of him and turned out to be another one's.
  void give_up_front(PersonFit& fit) const {
    std::erase_if(fit.cells, [&](int cell) { return taken_(cell) != 0 && is_in_front(fit, cell); });
  }
  [[nodiscard]] float taken_share(const std::vector<int>& cells) const {
    return share_of(cells, [this](int cell) { return taken_(cell) != 0; });
  }

 private:
  static bool is_in_front(const PersonFit& fit, int cell) {
    return std::binary_search(fit.front.begin(), fit.front.end(), cell);
  }
  [[nodiscard]] std::vector<DepthSample> gather_samples(const KnownBox& known_box, const cv::Rect& area,
                                                        const PlacePrior& prior) const {
    std::vector<DepthSample> samples;
    const int step =
        std::max(1, static_cast<int>(std::ceil(std::sqrt(area.area() / double{kMaxGridSamples}))));
    for (int y = area.y + step / 2; y < area.br().y; y += step) {
      for (int x = area.x + step / 2; x < area.br().x; x += step) {
        if (depth_m_(y, x) > 0.0F && taken_(y, x) == 0)
          samples.push_back({depth_m_(y, x), prior.weight(middle_px(x), middle_px(y)) *
                                                 history_weight(y * depth_m_.cols + x, known_box.number)});
      }
    }
    for (const DepthKeypoint& k : keypoints_) {
      if (k.depth_m <= 0.0F || !contains(known_box.box, k)) continue;
      const int cell = camera_.cell_of_pixel(k.x, k.y);
      if (cell >= 0 && taken_(cell) == 0)
        samples.push_back({k.depth_m, prior.weight(k.x, k.y) * history_weight(cell, known_box.number)});
    }
    return samples;
  }

  /// What moved lately, or was somebody before, is more likely to be the person.
  [[nodiscard]] float history_weight(int cell, std::uint8_t number) const {
    const float known = number != 0 && scene_.people(cell) == number ? kKnownWeight : 1.0F;
    return known * (scene_.still.free_age(cell) >= StillSurface::kStillAge ? kStillWeight : 1.0F);
  }

  const GridCamera& camera_;
  const SceneEvidence& scene_;
  const cv::Mat1f& depth_m_;
  std::span<const DepthKeypoint> keypoints_;
  Random& random_;
  cv::Mat1b taken_;
  PersonGrowth growth_;
};

}  // namespace

float outline_match(const std::vector<int>& cells, int columns, const cv::Rect& box_cells) {
  if (cells.empty()) return 0.0F;
  int left = columns, right = -1;
  for (const int cell : cells) {
    left = std::min(left, cell % columns);
    right = std::max(right, cell % columns);
  }
  const int top = cells.front() / columns;
  const int bottom = cells.back() / columns;
  const cv::Rect outline(left, top, right - left + 1, bottom - top + 1);
  const auto common = static_cast<float>((outline & box_cells).area());
  return common / (static_cast<float>(outline.area() + box_cells.area()) - common);
}

cv::Rect cells_of_box(const GridCamera& camera, const PersonBox& box) {
  // A caller's detector may bring anything.
  const bool is_box = std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) &&
                      std::isfinite(box.height) && box.width > 0.0 && box.height > 0.0;
  if (!is_box) return {};
  const auto cell = [](double px, int most) {
    return static_cast<int>(std::clamp(px / kDepthCellPx, 0.0, static_cast<double>(most)));
  };
  const int left = cell(box.x, camera.size().width);
  const int top = cell(box.y, camera.size().height);
  const int right = cell(box.x + box.width + kDepthCellPx - 1, camera.size().width);
  const int bottom = cell(box.y + box.height + kDepthCellPx - 1, camera.size().height);
  if (right <= left || bottom <= top) return {};
  return {left, top, right - left, bottom - top};
}

std::vector<PersonFit> fit_people(const GridCamera& camera, const SceneEvidence& scene,
                                  std::span<const KnownBox> boxes, std::span<const DepthKeypoint> keypoints,
                                  Random& random) {
  Fitter fitter(camera, scene, keypoints, random);
  std::vector<PersonFit> fits;
  fits.reserve(boxes.size());
  for (const KnownBox& box : boxes) fits.push_back(fitter.fit(box));
  std::vector<std::size_t> surest_first(boxes.size());
  std::iota(surest_first.begin(), surest_first.end(), std::size_t{0});
  std::stable_sort(surest_first.begin(), surest_first.end(),
                   [&](std::size_t a, std::size_t b) { return fits[a].match > fits[b].match; });
  for (const std::size_t i : surest_first) {
    // A box that shows mostly a person who was found before, in front of its own.
    if (fitter.taken_share(fits[i].cells) > kOverlapShare) fits[i] = fitter.fit(boxes[i]);
    fitter.take(fits[i]);
  }
  for (PersonFit& fit : fits) fitter.give_up_front(fit);
  return fits;
}

}  // namespace cpslam
