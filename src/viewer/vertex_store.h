#pragma once

#include <cstddef>
#include <vector>

#include "viewer/scene_shapes.h"

namespace cpslam::viewer {

/// Points in the graphics card's memory: attribute 0 the position, 1 the colour. Lives in the thread of its
/// OpenGL context, as does SegmentStore.
class PointStore {
 public:
  PointStore();
  ~PointStore();
  PointStore(const PointStore&) = delete;
  PointStore& operator=(const PointStore&) = delete;

  void set(const std::vector<Vertex>& vertices);
  void draw() const;
  [[nodiscard]] std::size_t size() const { return count_; }

 private:
  unsigned array_ = 0;
  unsigned buffer_ = 0;
  std::size_t count_ = 0;
};

/// Lines: each is an instance of a quad, attributes 0 and 1 its first end, 2 and 3 its second.
class SegmentStore {
 public:
  SegmentStore();
  ~SegmentStore();
  SegmentStore(const SegmentStore&) = delete;
  SegmentStore& operator=(const SegmentStore&) = delete;

  void set(const std::vector<Segment>& segments);
  void draw() const;

 private:
  unsigned array_ = 0;
  unsigned buffer_ = 0;
  std::size_t count_ = 0;
};

}  // namespace cpslam::viewer
