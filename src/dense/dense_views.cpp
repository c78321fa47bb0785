#include "dense/dense_views.h"

#include <shared_mutex>
#include <utility>

namespace cpslam {

DenseViews::DenseViews(const PinholeCamera& camera, std::size_t max_bytes, Log log)
    : camera_(std::make_shared<const DenseCamera>(camera)), max_bytes_(max_bytes), log_(std::move(log)) {}

void DenseViews::add(KeyFrameId keyframe, const DenseFrame& frame, const SE3& view_from_keyframe,
                     const Map& map) {
  auto view = std::make_shared<const DenseView>(make_dense_view(*camera_, frame));
  n_bytes_ += view->n_bytes();
  entries_.push_back({keyframe, view_from_keyframe, std::move(view)});
  while (n_bytes_ > max_bytes_ && entries_.size() > 1) {
    if (n_dropped_++ == 0)
      log_.warning("the dense map's memory is full: from now on it goes without some of the keyframes");
    const auto dispensable = entries_.begin() + static_cast<std::ptrdiff_t>(most_dispensable(map));
    n_bytes_ -= dispensable->view->n_bytes();
    entries_.erase(dispensable);
  }
}

std::size_t DenseViews::most_dispensable(const Map& map) const {
  const std::shared_lock lock(map.mutex());
  std::size_t nearest = 0;
  double nearest_m = -1.0;
  SE3 last;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const KeyFrameId id = entries_[i].keyframe;
    if (map.keyframe(id) == nullptr) return i;
    const SE3 cam_from_world = *map.cam_from_world(id);
    const SE3 moved = cam_from_world * last.inverse();
    // A turn by a radian changes what is seen about as much as two metres do.
    const double change_m = moved.translation.norm() + 2.0 * rotation_angle(moved.rotation);
    if (i > 0 && (nearest_m < 0.0 || change_m < nearest_m)) {
      nearest = i;
      nearest_m = change_m;
    }
    last = cam_from_world;
  }
  return nearest;
}

std::vector<PlacedView> DenseViews::place(const Map& map, int session) const {
  const std::shared_lock lock(map.mutex());
  std::vector<PlacedView> placed;
  for (const Entry& entry : entries_) {
    if (map.session_of(entry.keyframe) != session) continue;
    if (const auto cam_from_world = map.cam_from_world(entry.keyframe))
      placed.push_back({entry.view, (entry.view_from_keyframe * *cam_from_world).inverse()});
  }
  return placed;
}

}  // namespace cpslam
