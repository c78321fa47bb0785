#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "cpslam/rgbd_frame.h"
#include "cpslam/types.h"

namespace cpslam {

/// A person as the depth camera saw him in a frame.
struct PersonShape {
  std::uint8_t number = 0;  ///< as in FrameView::person_mask; the same from frame to frame
  bool hidden = false;      ///< behind something: where he must be, not where he was seen
  std::vector<WorldPoint> surface;
  float spacing_m = 0.0F;  ///< between neighbouring points of the surface, about
  WorldPoint velocity_m_per_s{};
};

/// What a viewer shows of one frame.
struct FrameSnapshot {
  std::uint64_t index = 0;  ///< of the frame, from 0
  TrackResult result;
  cv::Mat image;  ///< a copy of the frame's colour image
  FrameView view;
  std::vector<WorldPoint> tracked_points;  ///< map points the pose stands on
  std::vector<PersonShape> people;         ///< none in a frame that was not tracked
  std::vector<StageTimes> stages;          ///< of the run so far
  bool localization = false;               ///< nothing is mapped, System::set_localization()
};

/// An edge between two keyframes, by their places in MapSnapshot::keyframes.
struct KeyFrameEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// What a viewer shows of the map that the camera is in.
struct MapSnapshot {
  int map = 1;  ///< its number (StampedPose::map)
  std::vector<WorldPoint> points;
  Trajectory keyframes;                    ///< by age
  std::vector<KeyFrameEdge> covisibility;  ///< the strong ones: kStrongEdge points shared
  std::vector<KeyFrameEdge> spanning_tree;
  std::vector<KeyFrameEdge> loops;
  Trajectory trajectory;          ///< of System::trajectory() at that time what is in this map
  std::uint64_t corrections = 0;  ///< how often the whole map has been bent

  static constexpr int kStrongEdge = 100;
};

enum class SnapshotWish {
  kNone,
  kWhenCheap,  ///< seldom enough that tracking is hardly slower for it
  kEvery,      ///< of every frame until another wish comes, whatever they cost: to go step by step
};

/// Where a System lays down what somebody wants to see, and he picks it up: nothing is copied unless it was
/// asked for. Snapshots are immutable. Thread-safe.
class SnapshotBoard {
 public:
  /// One more of the kind, or with kEvery all that come.
  void request_frame(SnapshotWish wish);
  void request_map(SnapshotWish wish);
  [[nodiscard]] SnapshotWish frame_wish() const;
  [[nodiscard]] SnapshotWish map_wish() const;

  /// Answers the wish.
  void publish(std::shared_ptr<const FrameSnapshot> frame);
  void publish(std::shared_ptr<const MapSnapshot> map);

  /// The newest; null before the first.
  [[nodiscard]] std::shared_ptr<const FrameSnapshot> frame() const;
  [[nodiscard]] std::shared_ptr<const MapSnapshot> map() const;

 private:
  mutable std::mutex mutex_;  // guards all below
  SnapshotWish frame_wish_ = SnapshotWish::kNone;
  SnapshotWish map_wish_ = SnapshotWish::kNone;
  std::shared_ptr<const FrameSnapshot> frame_;
  std::shared_ptr<const MapSnapshot> map_;
};

}  // namespace cpslam
