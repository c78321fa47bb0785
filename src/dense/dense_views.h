#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "dense/dense_view.h"
#include "map/map.h"
#include "util/log.h"

namespace cpslam {

/// A view where its keyframe ended up.
struct PlacedView {
  std::shared_ptr<const DenseView> view;
  SE3 world_from_view;
};

/// The views of keyframes, for a dense map. A culled keyframe's view stays and moves with the keyframe's
/// nearest living ancestor, as the poses of frames do: where people come and go, it may be the only one that
/// saw a piece of the floor, and each one more that sees through somebody unnoticed carves him away. Only
/// when memory runs out they go first. One thread.
class DenseViews {
 public:
  /// max_bytes: of all views together.
  DenseViews(const PinholeCamera& camera, std::size_t max_bytes, Log log);

  /// view_from_keyframe: for a depth image of another instant than the keyframe's colour.
  void add(KeyFrameId keyframe, const DenseFrame& frame, const SE3& view_from_keyframe, const Map& map);

  /// Those of a session of the map, by the order in which they were added. Takes a shared lock of the map.
  [[nodiscard]] std::vector<PlacedView> place(const Map& map, int session = 1) const;

  [[nodiscard]] const std::shared_ptr<const DenseCamera>& camera() const { return camera_; }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::size_t n_dropped() const { return n_dropped_; }

 private:
  struct Entry {
    KeyFrameId keyframe;
    SE3 view_from_keyframe;
    std::shared_ptr<const DenseView> view;
  };
  [[nodiscard]] std::size_t most_dispensable(const Map& map) const;

  std::shared_ptr<const DenseCamera> camera_;
  std::size_t max_bytes_;
  std::size_t n_bytes_ = 0;
  std::size_t n_dropped_ = 0;
  Log log_;
  std::vector<Entry> entries_;
};

}  // namespace cpslam
