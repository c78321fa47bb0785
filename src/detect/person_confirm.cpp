#include "detect/person_confirm.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "detect/box_overlap.h"
#include "detect/grid_cells.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

constexpr float kMinOverlap = 0.3F;
constexpr float kAroundBox = 0.15F;  // of its size
constexpr int kMinFitCells = 4;
constexpr int kMaxMisses = 3;
constexpr int kConfirmationsToTrust = 3;
constexpr float kFurnitureShare = 0.5F;  // of a surface that stands still
constexpr double kMinMissedS = 0.7;
constexpr double kMinMissedDoubtfulS = 0.2;  // who was missed more often in a row than detected in all
constexpr double kHiddenS = 0.7;             // behind somebody else, say
constexpr double kUnseenBoxS = 0.2;          // a box without any depth cannot be carried
constexpr double kUndetectedS = 5.0;
constexpr int kMinContacts = 3;
constexpr std::size_t kMaxPeople = 254;

struct Pair {
  float overlap;
  std::size_t box;
  std::size_t track;
};

void put_best_first(std::vector<Pair>& pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
}

/// Who is expected in each box, judged by the boxes alone; nobody in two of them.
std::vector<KnownBox> recognise(std::span<const PersonBox> boxes, const std::vector<PersonTrack>& tracks) {
  std::vector<KnownBox> known(boxes.size());
  std::vector<Pair> pairs;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    known[b].box = boxes[b];
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const float overlap = box_overlap(boxes[b], tracks[t].box);
      if (overlap > kMinOverlap) pairs.push_back({overlap, b, t});
    }
  }
  put_best_first(pairs);
  std::vector<bool> track_used(tracks.size(), false);
  for (const Pair& pair : pairs) {
    if (known[pair.box].number != 0 || track_used[pair.track]) continue;
    track_used[pair.track] = true;
    known[pair.box].number = tracks[pair.track].number;
    known[pair.box].moves = is_walking(tracks[pair.track]);
  }
  return known;
}

/// Boxes and people that may belong together, best first.
std::vector<Pair> find_pairs(std::span<const PersonBox> boxes, const std::vector<PersonFit>& fits,
                             const std::vector<PersonTrack>& tracks, const cv::Mat1b& labels) {
  std::vector<Pair> pairs;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    std::array<std::size_t, 256> shared{};
    for (const int cell : fits[b].cells) ++shared[labels(cell)];
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      const std::size_t smaller = std::min(fits[b].cells.size(), tracks[t].visible.size());
      const float of_surface =
          smaller == 0 ? 0.0F : static_cast<float>(shared[tracks[t].number]) / static_cast<float>(smaller);
      const float of_box = box_overlap(boxes[b], tracks[t].box);
      // Two people one behind the other share a box; the surface says who it is.
      if (std::max(of_surface, of_box) >= kMinOverlap) pairs.push_back({of_surface + 0.5F * of_box, b, t});
    }
  }
  put_best_first(pairs);
  return pairs;
}

std::uint8_t free_number(const std::vector<PersonTrack>& tracks) {
  std::array<bool, kMaxPeople + 1> used{};
  for (const PersonTrack& track : tracks) used.at(track.number) = true;
  std::uint8_t number = 1;
  while (used.at(number)) ++number;
  return number;
}

float still_share(const std::vector<int>& cells, const cv::Mat1b& still_age) {
  return share_of(cells, [&](int cell) { return still_age(cell) >= StillSurface::kStillAge; });
}

/// Whether the fit found somebody or something else than who was carried here, who suits the box better.
bool is_mistaken(const PersonFit& fit, const cv::Mat1b& fitted, const PersonTrack& track,
                 const cv::Rect& box_cells) {
  if (track.confirmations < kConfirmationsToTrust || track.visible.size() < kMinFitCells) return false;
  const auto shared = std::count_if(track.visible.cells.begin(), track.visible.cells.end(),
                                    [&](int cell) { return fitted(cell) != 0; });
  const auto smaller = static_cast<float>(std::min(fit.cells.size(), track.visible.size()));
  if (static_cast<float>(shared) >= kMinOverlap * smaller) return false;
  std::vector<int> carried = track.visible.cells;
  std::sort(carried.begin(), carried.end());
  return outline_match(carried, fitted.cols, box_cells) > fit.match;
}

/// The fit, and what was carried to the box or close to it and does not stand still: detectors' boxes cut off
/// hands and feet, and fits lose limbs.
void merge(const PersonFit& fit, const cv::Mat1b& fitted, const cv::Rect& box_cells, const cv::Mat1f& depth_m,
           const cv::Mat1b& still_age, PersonTrack& track) {
  const int reach_x = static_cast<int>(kAroundBox * static_cast<float>(box_cells.width));
  const int reach_y = static_cast<int>(kAroundBox * static_cast<float>(box_cells.height));
  const cv::Rect around(box_cells.x - reach_x, box_cells.y - reach_y, box_cells.width + 2 * reach_x,
                        box_cells.height + 2 * reach_y);
  GridSurface merged;
  for (const int cell : fit.cells) merged.add(cell, depth_m(cell));
  for (const int cell : track.visible.cells) {
    const cv::Point at(cell % depth_m.cols, cell / depth_m.cols);
    if (!around.contains(at) || still_age(cell) >= StillSurface::kStillAge) continue;
    if (fitted(cell) == 0) merged.add(cell, depth_m(cell));
  }
  track.visible = std::move(merged);
}

void confirm(const GridCamera& camera, const PersonBox& box, const PersonFit& fit, const cv::Mat1f& depth_m,
             const cv::Mat1b& still_age, double time_s, PersonTrack& track) {
  track.box = box;
  track.confirmed_s = time_s;
  ++track.confirmations;
  track.misses = 0;
  track.shown = true;
  if (fit.cells.size() < kMinFitCells) return;
  cv::Mat1b fitted(depth_m.size(), std::uint8_t{0});
  for (const int cell : fit.cells) fitted(cell) = 1;
  const cv::Rect box_cells = cells_of_box(camera, box);
  if (is_mistaken(fit, fitted, track, box_cells)) return;
  track.seen_s = time_s;
  merge(fit, fitted, box_cells, depth_m, still_age, track);
  track.shape = track.visible;
}

/// Whether somebody who was not detected is furniture that a fit once took for him: it stands still, and
/// another one's box shows it or it has been missed before.
bool is_furniture(const PersonTrack& track, const cv::Mat1b& boxed, const cv::Mat1b& still_age) {
  if (track.misses == 0 || still_share(track.visible.cells, still_age) < kFurnitureShare) return false;
  const auto shown = std::count_if(track.visible.cells.begin(), track.visible.cells.end(),
                                   [&](int cell) { return boxed(cell) != 0; });
  return track.misses > 1 || 2 * shown > static_cast<std::ptrdiff_t>(track.visible.size());
}

/// The track on whose surface a blob hangs without a step in depth, null when there is none.
PersonTrack* find_owner(const cv::Mat1f& depth_m, const GridSurface& blob, std::vector<PersonTrack>& tracks) {
  const cv::Mat1b labels = paint_people(tracks, depth_m.size());
  std::array<int, 256> contacts{};
  for (std::size_t i = 0; i < blob.size(); ++i) {
    const cv::Point at(blob.cells[i] % depth_m.cols, blob.cells[i] / depth_m.cols);
    for (const cv::Point& next : neighbours(at)) {
      if (!cv::Rect({}, depth_m.size()).contains(next)) continue;
      if (std::abs(depth_m(next) - blob.depth_m[i]) < connected_step_m(blob.depth_m[i]))
        ++contacts[labels(next)];
    }
  }
  contacts[0] = 0;
  const auto most = std::max_element(contacts.begin(), contacts.end());
  if (*most < kMinContacts) return nullptr;
  const auto number = static_cast<std::uint8_t>(most - contacts.begin());
  return &*std::find_if(tracks.begin(), tracks.end(),
                        [number](const PersonTrack& t) { return t.number == number; });
}

/// Takes from those nobody has detected what turned out to be somebody who was; forgets whom that leaves
/// little of.
void absorb_undetected(cv::Size grid_size, std::vector<PersonTrack>& tracks) {
  cv::Mat1b detected(grid_size, std::uint8_t{0});
  for (const PersonTrack& track : tracks) {
    if (track.confirmations == 0) continue;
    for (const int cell : track.visible.cells) detected(cell) = 1;
  }
  std::erase_if(tracks, [&](const PersonTrack& track) {
    if (track.confirmations > 0) return false;
    const auto n = std::count_if(track.visible.cells.begin(), track.visible.cells.end(),
                                 [&](int cell) { return detected(cell) != 0; });
    return 2 * n >= static_cast<std::ptrdiff_t>(track.visible.size());
  });
}

bool is_missed_too_often(const PersonTrack& track, double time_s) {
  if (track.confirmations == 0) return false;  // what moves need not be a person
  const double least_s = track.misses > track.confirmations ? kMinMissedDoubtfulS : kMinMissedS;
  return track.misses > std::min(track.confirmations, kMaxMisses) && time_s - track.confirmed_s > least_s;
}

}  // namespace

void confirm_people(const GridCamera& camera, const cv::Mat1f& depth_m, const StillSurface& still,
                    double time_s, std::span<const PersonBox> boxes, std::span<const DepthKeypoint> keypoints,
                    Random& random, std::vector<PersonTrack>& tracks) {
  const cv::Mat1b labels = paint_people(tracks, depth_m.size());
  const std::vector<PersonFit> fits =
      fit_people(camera, {depth_m, labels, still}, recognise(boxes, tracks), keypoints, random);
  std::vector<bool> box_used(boxes.size(), false);
  std::vector<bool> track_used(tracks.size(), false);
  for (const Pair& pair : find_pairs(boxes, fits, tracks, labels)) {
    if (box_used[pair.box] || track_used[pair.track]) continue;
    box_used[pair.box] = true;
    track_used[pair.track] = true;
    confirm(camera, boxes[pair.box], fits[pair.box], depth_m, still.age, time_s, tracks[pair.track]);
  }
  for (std::size_t t = 0; t < track_used.size(); ++t) tracks[t].misses += track_used[t] ? 0 : 1;
  cv::Mat1b boxed(depth_m.size(), std::uint8_t{0});
  for (const PersonBox& box : boxes) boxed(cells_of_box(camera, box)).setTo(1);
  std::erase_if(tracks, [&](const PersonTrack& track) {
    return is_missed_too_often(track, time_s) || is_furniture(track, boxed, still.age);
  });
  for (std::size_t b = 0; b < boxes.size() && tracks.size() < kMaxPeople; ++b) {
    if (box_used[b]) continue;
    PersonTrack track;
    track.number = free_number(tracks);
    track.seen_s = time_s;
    confirm(camera, boxes[b], fits[b], depth_m, still.age, time_s, track);
    tracks.push_back(std::move(track));
  }
  absorb_undetected(depth_m.size(), tracks);
}

void add_blobs(const cv::Mat1f& depth_m, const std::vector<GridSurface>& blobs, double time_s,
               std::vector<PersonTrack>& tracks) {
  for (const GridSurface& blob : blobs) {
    if (PersonTrack* owner = find_owner(depth_m, blob, tracks)) {
      for (std::size_t i = 0; i < blob.size(); ++i) owner->visible.add(blob.cells[i], blob.depth_m[i]);
      owner->shape = owner->visible;
      continue;
    }
    if (tracks.size() >= kMaxPeople) return;
    PersonTrack track;
    track.number = free_number(tracks);
    track.visible = blob;
    track.shape = blob;
    track.confirmed_s = time_s;
    track.seen_s = time_s;
    tracks.push_back(std::move(track));
  }
}

void drop_what_stays(const StillSurface& still, double dt_s, std::vector<PersonTrack>& tracks) {
  for (PersonTrack& track : tracks) {
    if (!is_walking(track) || dt_s <= 0.0) continue;
    const int limit = passing_frames(track, dt_s);
    GridSurface moving;
    for (std::size_t i = 0; i < track.visible.size(); ++i) {
      if (still.age(track.visible.cells[i]) <= limit)
        moving.add(track.visible.cells[i], track.visible.depth_m[i]);
    }
    const bool was_shape = track.shape.size() == track.visible.size();
    track.visible = std::move(moving);
    if (was_shape) track.shape = track.visible;
  }
}

void forget_people(double time_s, const cv::Mat1b& still_age, std::vector<PersonTrack>& tracks) {
  std::erase_if(tracks, [&](const PersonTrack& track) {
    if (track.confirmations == 0 && still_share(track.visible.cells, still_age) > kFurnitureShare)
      return true;
    const double patience_s = track.shape.size() == 0 ? kUnseenBoxS : kHiddenS;
    return time_s - track.seen_s > patience_s || time_s - track.confirmed_s > kUndetectedS;
  });
}

}  // namespace cpslam
