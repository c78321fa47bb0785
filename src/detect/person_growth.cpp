#include "detect/person_growth.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "detect/grid_cells.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

constexpr float kFrontBandM = 0.7F;     // limits of the growth: an arm stretched out to the camera,
constexpr float kBackBandM = 1.0F;      // a leg behind
constexpr float kMinPieceShare = 0.2F;  // of the largest piece
constexpr float kMovingShare = 0.4F;    // of cells that have just arrived: then a piece moves
constexpr float kWalkingShare = 0.2F;   // the same of a whole person, whose inside seems to stand still
constexpr std::size_t kMinMovingCells = 4;
constexpr float kNearerM = 0.3F;      // than the body: an arm that reaches out to the camera,
constexpr float kMaxArmShare = 0.3F;  // unless it is as large as somebody else, by the body's cells
constexpr std::size_t kMinLimbCells = 6;
constexpr float kMaxLimbShare = 0.2F;  // of the body's cells
constexpr float kLimbM = 0.7F;         // before or behind the body
constexpr float kYoungShare = 0.8F;    // of a limb's cells
constexpr float kMaxPieceLeak = 0.5F;  // cells that go on outside the box, by the root of all
constexpr float kInlierStepM = 0.1F;   // more between two inliers
constexpr int kMarginCells = 1;        // that a person may reach over his box
constexpr int kGapCells = 3;           // without readings

}  // namespace

PersonGrowth::PersonGrowth(const SceneEvidence& scene, const cv::Mat1b& taken)
    : scene_(scene), depth_m_(scene.depth_m), taken_(taken), piece_(scene.depth_m.size(), 0) {}

GrownSurface PersonGrowth::grow(const SdfModel& model, const cv::Rect& box_cells, const PlacePrior& prior,
                                const std::vector<GridPlane>& background, const KnownBox& known) {
  model_ = model;
  background_ = &background;
  known_ = known;
  front_m_ = model.mean_m - kFrontBandM;
  limits_ = cv::Rect(box_cells.x - kMarginCells, box_cells.y - kMarginCells,
                     box_cells.width + 2 * kMarginCells, box_cells.height + 2 * kMarginCells) &
            cv::Rect({}, depth_m_.size());
  piece_(limits_).setTo(0);
  std::vector<std::vector<int>> pieces;
  std::vector<float> weights;
  for (int y = box_cells.y; y < box_cells.br().y; ++y) {
    for (int x = box_cells.x; x < box_cells.br().x; ++x) {
      if (piece_(y, x) != 0 || !model_.contains(depth_m_(y, x)) || !is_free(x, y)) continue;
      pieces.push_back(flood(y * depth_m_.cols + x, static_cast<int>(pieces.size()) + 1));
      weights.push_back(weigh(pieces.back(), prior));
    }
  }
  GrownSurface surface;
  if (pieces.empty()) return surface;
  const auto largest = std::max_element(weights.begin(), weights.end());
  const float enough = kMinPieceShare * *largest;
  const bool he_moves =
      known_.moves ||
      arrived_share(pieces[static_cast<std::size_t>(largest - weights.begin())]) > kWalkingShare;
  int leaks = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (static_cast<std::ptrdiff_t>(i) != largest - weights.begin()) {
      const bool large = weights[i] >= enough && (!he_moves || was_his(pieces[i]));
      if (!moves(pieces[i]) && (!large || leaks_much(pieces[i]))) continue;
    }
    leaks += count_leaks(pieces[i]);
    surface.cells.insert(surface.cells.end(), pieces[i].begin(), pieces[i].end());
  }
  add_limbs(box_cells, static_cast<int>(pieces.size()) + 1, he_moves, surface);
  put_in_order(surface.cells);
  std::sort(surface.front.begin(), surface.front.end());
  surface.leak = static_cast<float>(leaks) / static_cast<float>(box_cells.width + box_cells.height);
  return surface;
}

void PersonGrowth::add_limbs(const cv::Rect& box_cells, int piece_number, bool he_moves,
                             GrownSurface& surface) {
  const std::size_t body_cells = surface.cells.size();
  front_m_ = 0.0F;
  for (int y = box_cells.y; y < box_cells.br().y; ++y) {
    for (int x = box_cells.x; x < box_cells.br().x; ++x) {
      const bool young = scene_.still.age(y, x) < StillSurface::kStillAge;
      if (!young || piece_(y, x) != 0 || !in_band(depth_m_(y, x)) || !is_free(x, y)) continue;
      const std::vector<int> piece = flood(y * depth_m_.cols + x, piece_number++);
      const float depth_m = mean_depth_m(piece);
      const bool in_front = depth_m < model_.mean_m - kNearerM;
      const bool as_large = static_cast<float>(piece.size()) > kMaxArmShare * static_cast<float>(body_cells);
      const bool is_somebody_else = in_front && as_large;
      const bool is_his =
          (moves(piece) && !is_somebody_else) || (he_moves && is_limb(piece, depth_m, body_cells));
      if (!is_his) continue;
      surface.cells.insert(surface.cells.end(), piece.begin(), piece.end());
      if (in_front) surface.front.insert(surface.front.end(), piece.begin(), piece.end());
    }
  }
}

bool PersonGrowth::is_limb(const std::vector<int>& piece, float depth_m, std::size_t body_cells) const {
  return piece.size() >= kMinLimbCells &&
         static_cast<float>(piece.size()) < kMaxLimbShare * static_cast<float>(body_cells) &&
         std::abs(depth_m - model_.mean_m) < kLimbM && !leaks_much(piece) &&
         younger_share(piece, StillSurface::kStillAge) > kYoungShare;
}

void PersonGrowth::put_in_order(std::vector<int>& cells) {
  constexpr int kChosen = -1;
  for (const int cell : cells) piece_(cell) = kChosen;
  cells.clear();
  for (int y = limits_.y; y < limits_.br().y; ++y) {
    for (int x = limits_.x; x < limits_.br().x; ++x) {
      if (piece_(y, x) == kChosen) cells.push_back(y * depth_m_.cols + x);
    }
  }
}

float PersonGrowth::younger_share(const std::vector<int>& cells, std::uint8_t age) const {
  return share_of(cells, [&](int cell) { return scene_.still.age(cell) < age; });
}

float PersonGrowth::mean_depth_m(const std::vector<int>& cells) const {
  float sum = 0.0F;
  for (const int cell : cells) sum += depth_m_(cell);
  return sum / static_cast<float>(cells.size());
}

float PersonGrowth::arrived_share(const std::vector<int>& cells) const {
  return younger_share(cells, StillSurface::kUnknownAge);
}

bool PersonGrowth::moves(const std::vector<int>& piece) const {
  return piece.size() >= kMinMovingCells && arrived_share(piece) >= kMovingShare;
}

bool PersonGrowth::was_his(const std::vector<int>& piece) const {
  const auto n = std::count_if(piece.begin(), piece.end(),
                               [this](int cell) { return scene_.people(cell) == known_.number; });
  return known_.number != 0 && 2 * n > static_cast<std::ptrdiff_t>(piece.size());
}

bool PersonGrowth::leaks_much(const std::vector<int>& piece) const {
  return static_cast<float>(count_leaks(piece)) > kMaxPieceLeak * std::sqrt(static_cast<float>(piece.size()));
}

bool PersonGrowth::in_band(float depth_m) const {
  return depth_m >= front_m_ && depth_m <= model_.mean_m + kBackBandM;
}

int PersonGrowth::count_leaks(const std::vector<int>& cells) const {
  const cv::Rect grid({}, depth_m_.size());
  int leaks = 0;
  for (const int cell : cells) {
    const cv::Point at(cell % depth_m_.cols, cell / depth_m_.cols);
    const auto goes_on = [&](cv::Point next) {
      return grid.contains(next) && !limits_.contains(next) && depth_m_(next) > 0.0F && taken_(next) == 0 &&
             std::abs(depth_m_(next) - depth_m_(at)) < connected_step_m(depth_m_(at));
    };
    const bool on_limit =
        at.x == limits_.x || at.y == limits_.y || at.x + 1 == limits_.br().x || at.y + 1 == limits_.br().y;
    if (!on_limit) continue;
    const auto beside = neighbours(at);
    leaks += std::any_of(beside.begin(), beside.end(), goes_on) ? 1 : 0;
  }
  return leaks;
}

bool PersonGrowth::is_free(int x, int y) const {
  const float depth_m = depth_m_(y, x);
  if (depth_m <= 0.0F || taken_(y, x) != 0) return false;
  // Nearer than he reaches is only who is nobody else.
  if (depth_m < model_.mean_m - kFrontBandM && scene_.people(y, x) != 0 &&
      scene_.people(y, x) != known_.number)
    return false;
  return std::none_of(background_->begin(), background_->end(),
                      [&](const GridPlane& plane) { return plane.contains(x, y, depth_m); });
}

std::vector<int> PersonGrowth::flood(int seed, int number) {
  std::vector<int> cells{seed};
  piece_(seed) = number;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      visit_neighbour(cells[i], dx, dy, number, cells);
    }
  }
  return cells;
}

void PersonGrowth::visit_neighbour(int from, int dx, int dy, int number, std::vector<int>& cells) {
  cv::Point next(from % depth_m_.cols + dx, from / depth_m_.cols + dy);
  int gap = 0;
  while (gap < kGapCells && limits_.contains(next) && depth_m_(next) <= 0.0F) {
    next += cv::Point(dx, dy);
    ++gap;
  }
  if (!limits_.contains(next) || piece_(next) != 0) return;
  const float here_m = depth_m_(from);
  const float depth_m = depth_m_(next);
  if (!in_band(depth_m)) return;
  const bool both_inliers = model_.contains(here_m) && model_.contains(depth_m);
  const float step_m = connected_step_m(depth_m) + (both_inliers ? kInlierStepM : 0.0F);
  if (std::abs(depth_m - here_m) > step_m || !is_free(next.x, next.y)) return;
  piece_(next) = number;
  cells.push_back(next.y * depth_m_.cols + next.x);
}

float PersonGrowth::weigh(const std::vector<int>& cells, const PlacePrior& prior) const {
  float sum = 0.0F;
  for (const int cell : cells) {
    if (!model_.contains(depth_m_(cell))) continue;
    sum += prior.weight(middle_px(cell % depth_m_.cols), middle_px(cell / depth_m_.cols));
  }
  return sum;
}

}  // namespace cpslam
