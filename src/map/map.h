#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "features/scale_pyramid.h"
#include "map/ids.h"
#include "map/keyframe.h"
#include "map/map_parts.h"
#include "map/map_point.h"
#include "util/fair_shared_mutex.h"

namespace cpslam {

/// Owns all keyframes and map points; everything else refers to them by id.
///
/// Its sessions are maps that nothing connects, each in a world of its own, numbered from 1: a point and all
/// keyframes that see it, a keyframe and its covisible ones, its parent and its loops are of one session. The
/// first keyframe of a session is its root, the oldest it ever has, and holds its gauge.
///
/// Locking: one mutex for everything in here. Const members need at least a shared lock of mutex(), the
/// others a unique one, held by the caller, so that several calls make one consistent step. It is the only
/// lock of the core that is held while another module runs, so there is no lock order to keep; do not call
/// back into a Worker while holding it, nor ask for it twice.
class Map {
 public:
  /// sessions_created: numbers that are taken.
  explicit Map(const ScalePyramid& pyramid, int sessions_created = 0)
      : pyramid_(pyramid), sessions_created_(sessions_created) {}
  Map(const Map&) = delete;
  Map& operator=(const Map&) = delete;

  [[nodiscard]] FairSharedMutex& mutex() const { return mutex_; }

  /// Adds parts that check() has passed as a session; returns the ids of the keyframes by their positions.
  /// What a map knows beyond its parts is worked out anew.
  std::vector<KeyFrameId> assemble(const MapParts& parts);

  // Keyframes
  // -------------------------------------------------------------------------------------------------
  /// Adds a keyframe without points or links; sets its sequence and sizes its points. The first of a session
  /// that is not there yet begins it.
  KeyFrameId add_keyframe(KeyFrame keyframe);
  [[nodiscard]] const KeyFrame* keyframe(KeyFrameId id) const { return keyframes_.find(id); }
  void set_pose(KeyFrameId id, const SE3& cam_from_world);
  /// Frees a keyframe: its observations go (and the points that lose too many), its children find new
  /// parents, and a tombstone keeps its pose relative to its parent. Roots and the ends of loop edges stay:
  /// returns false for them.
  bool erase_keyframe(KeyFrameId id);
  /// Pose of a live or culled keyframe; a culled one's follows from the pose of its nearest living ancestor.
  [[nodiscard]] std::optional<SE3> cam_from_world(KeyFrameId id) const;
  /// The keyframe itself, or for a culled one its nearest living ancestor.
  [[nodiscard]] KeyFrameId living(KeyFrameId id) const;
  [[nodiscard]] std::vector<KeyFrameId> keyframes_by_sequence() const;

  // Points
  // ----------------------------------------------------------------------------------------------------
  /// Adds a point with its first observation; its descriptor, normal and distance range come from there.
  MapPointId add_point(const Eigen::Vector3d& position_in_world, const Observation& first);
  [[nodiscard]] const MapPoint* point(MapPointId id) const { return points_.find(id); }
  [[nodiscard]] std::vector<MapPointId> point_ids() const;
  void set_position(MapPointId id, const Eigen::Vector3d& position_in_world);
  void count_visible(MapPointId id, bool found);
  void erase_point(MapPointId id);
  /// Moves old's observations to kept (where kept has none in that keyframe yet) and erases old.
  void merge_points(MapPointId old, MapPointId kept);

  // Links between them
  // ------------------------------------------------------------------------------------------
  /// Returns false, and does nothing, when either is gone, the keypoint is taken, or the keyframe sees the
  /// point.
  bool add_observation(MapPointId point, const Observation& observation);
  /// A point left with fewer than two observations and no depth to stand on its own goes with it.
  void erase_observation(MapPointId point, KeyFrameId keyframe);
  /// Keypoint of the keyframe that sees the point, or -1.
  [[nodiscard]] int keypoint_of(MapPointId point, KeyFrameId keyframe) const;
  /// Recomputes descriptor, normal and distance range of a point from its observations.
  void refresh_point(MapPointId id);
  /// Only the normal and the distance range: enough where points and keyframes have moved, and cheaper.
  void refresh_geometry(MapPointId id);
  /// refresh_point() for every point the keyframe sees.
  void refresh_points_of(KeyFrameId keyframe);

  // Covisibility graph and spanning tree
  // ------------------------------------------------------------------------
  /// Recounts the keyframe's covisibility edges; the first time it also gets its parent in the spanning tree.
  void update_covisibility(KeyFrameId id);
  /// The n keyframes that share most points with this one.
  [[nodiscard]] std::vector<KeyFrameId> best_covisible(KeyFrameId id, std::size_t n) const;
  /// Joins two keyframes that show the same place. Does nothing when either is gone.
  void add_loop_edge(KeyFrameId a, KeyFrameId b);
  /// Points of the keyframe that at least min_observations keyframes see.
  [[nodiscard]] int count_points(KeyFrameId id, std::size_t min_observations) const;

  // Sessions
  // ----------------------------------------------------------------------------------------------------
  /// Numbers of those that are there, the oldest first.
  [[nodiscard]] std::vector<int> sessions() const;
  /// Of a live or culled keyframe; 0 for one that never was.
  [[nodiscard]] int session_of(KeyFrameId id) const;
  [[nodiscard]] bool is_root(KeyFrameId id) const;
  /// Makes one session of two that a loop connects. The one with the younger root moves into the world of the
  /// other, takes its number, and hangs on it by the loop: its end becomes a child of the other end. Returns
  /// the number that is no more; 0, and does nothing, when either end is gone or both are of one session.
  int join_sessions(KeyFrameId a, KeyFrameId b, const SE3& a_from_b);

  // Counts
  // ------------------------------------------------------------------------------------------------------
  [[nodiscard]] std::size_t n_keyframes() const { return keyframes_.size(); }
  [[nodiscard]] std::size_t n_points() const { return points_.size(); }
  [[nodiscard]] std::uint64_t keyframes_created() const { return keyframes_created_; }
  [[nodiscard]] std::uint64_t points_created() const { return points_created_; }
  /// The highest number of a session so far.
  [[nodiscard]] int sessions_created() const { return sessions_created_; }
  /// Grows with every change of structure or geometry; tells a reader when its copy is stale.
  [[nodiscard]] std::uint64_t version() const { return version_; }
  /// How often the map as a whole has been bent (a loop closed): a pose found before fits no more.
  [[nodiscard]] std::uint64_t corrections() const { return corrections_; }
  void count_correction() { ++corrections_; }

 private:
  struct Tombstone {
    KeyFrameId parent;
    SE3 cam_from_parent;
  };

  void assemble_point(const MapParts::PointPart& part, const std::vector<KeyFrameId>& ids);
  /// Moves everything of a session, new_from_old, and gives it to another one.
  void move_session(int session, int to, const SE3& new_from_old);
  /// Turns the way from the keyframe up to its root round, so that it is the root of its tree.
  void make_root(KeyFrameId id);
  /// How many points the keyframe shares with each other one.
  [[nodiscard]] std::map<KeyFrameId, int> count_shared(KeyFrameId id) const;
  /// Both ways, to each that shares enough points and to the one that shares most.
  void add_edges(KeyFrameId id, const std::map<KeyFrameId, int>& shared);
  void add_edge(KeyFrameId from, KeyFrameId to, int shared_points);
  void erase_edge(KeyFrameId from, KeyFrameId to);
  void adopt_children(KeyFrameId orphaned_by, const KeyFrame& dead);
  [[nodiscard]] bool descends_from(KeyFrameId id, KeyFrameId ancestor) const;

  mutable FairSharedMutex mutex_;
  ScalePyramid pyramid_;
  SlotMap<KeyFrame, KeyFrameTag> keyframes_;
  SlotMap<MapPoint, MapPointTag> points_;
  std::map<KeyFrameId, Tombstone> tombstones_;
  std::map<int, KeyFrameId> roots_;  // by session
  int sessions_created_ = 0;
  std::uint64_t keyframes_created_ = 0;
  std::uint64_t points_created_ = 0;
  std::uint64_t version_ = 0;
  std::uint64_t corrections_ = 0;
};

}  // namespace cpslam
