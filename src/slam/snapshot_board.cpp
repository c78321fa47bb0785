#include <utility>

#include "cpslam/snapshot.h"

namespace cpslam {

void SnapshotBoard::request_frame(SnapshotWish wish) {
  const std::lock_guard lock(mutex_);
  frame_wish_ = wish;
}

void SnapshotBoard::request_map(SnapshotWish wish) {
  const std::lock_guard lock(mutex_);
  map_wish_ = wish;
}

SnapshotWish SnapshotBoard::frame_wish() const {
  const std::lock_guard lock(mutex_);
  return frame_wish_;
}

SnapshotWish SnapshotBoard::map_wish() const {
  const std::lock_guard lock(mutex_);
  return map_wish_;
}

void SnapshotBoard::publish(std::shared_ptr<const FrameSnapshot> frame) {
  const std::lock_guard lock(mutex_);
  if (frame_wish_ != SnapshotWish::kEvery) frame_wish_ = SnapshotWish::kNone;
  frame_.swap(frame);  // the old one dies with the argument, after the lock
}

void SnapshotBoard::publish(std::shared_ptr<const MapSnapshot> map) {
  const std::lock_guard lock(mutex_);
  if (map_wish_ != SnapshotWish::kEvery) map_wish_ = SnapshotWish::kNone;
  map_.swap(map);
}

std::shared_ptr<const FrameSnapshot> SnapshotBoard::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

std::shared_ptr<const MapSnapshot> SnapshotBoard::map() const {
  const std::lock_guard lock(mutex_);
  return map_;
}

}  // namespace cpslam
