// What a map from a file must be before anything works with it.
#include <Eigen/LU>
#include <cmath>
#include <set>
#include <string>

#include "cpslam/error.h"
#include "map/map_parts.h"

namespace cpslam {
namespace {

// Beyond any building, and far from where sums and casts get into trouble.
constexpr double kFarthestM = 1e6;
constexpr double kFarthestPx = 1e6;
constexpr double kLargestRotationError = 1e-4;
constexpr std::uint64_t kMostCreated = std::uint64_t{1} << 62U;
constexpr std::uint32_t kMostCounted = std::uint32_t{1} << 30U;

void require(bool condition, const std::string& part, std::size_t position, const char* what) {
  if (!condition) throw InputError(part + " " + std::to_string(position) + " " + what);
}

bool is_near(const Eigen::Vector3d& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthestM;
}

bool is_rigid(const SE3& pose) {
  const Eigen::Matrix3d& r = pose.rotation;
  if (!r.allFinite() || !is_near(pose.translation)) return false;
  const Eigen::Matrix3d error = r.transpose() * r - Eigen::Matrix3d::Identity();
  return error.cwiseAbs().maxCoeff() < kLargestRotationError && r.determinant() > 0.0;
}

/// Within [0, most]; not for NaN.
bool is_length(float value, double most) {
  return value >= 0.0F && static_cast<double>(value) <= most;
}

bool is_sound(const FrameFeatures& features, int n_levels) {
  const auto n = static_cast<std::size_t>(features.size());
  for (std::size_t i = 0; i < n; ++i) {
    const Keypoint& k = features.keypoints[i];
    if (!is_length(std::abs(k.x), kFarthestPx) || !is_length(std::abs(k.y), kFarthestPx)) return false;
    if (!is_length(k.angle_deg, 360.0) || !std::isfinite(k.response)) return false;
    if (k.octave < 0 || k.octave >= n_levels) return false;
    if (!is_length(features.depth_m[i], kFarthestM) || !is_length(features.depth_sigma_m[i], kFarthestM))
      return false;
  }
  return true;
}

void check_keyframes(const MapParts& parts, int n_levels) {
  if (parts.keyframes.empty()) throw InputError("it has no keyframes");
  std::uint64_t next_sequence = 0;
  for (std::size_t i = 0; i < parts.keyframes.size(); ++i) {
    const MapParts::KeyFramePart& keyframe = parts.keyframes[i];
    const auto must = [i](bool condition, const char* what) { require(condition, "keyframe", i, what); };
    must(keyframe.sequence >= next_sequence, "comes before the one in front of it");
    must(keyframe.sequence < parts.keyframes_created, "was never made");
    next_sequence = keyframe.sequence + 1;
    must(std::isfinite(keyframe.time_s), "has no time");
    must(is_rigid(keyframe.cam_from_world), "has a pose that is none");
    must(is_sound(*keyframe.features, n_levels), "has a feature that is none");
    must(keyframe.parent == MapParts::kNone || keyframe.parent < parts.keyframes.size(),
         "has a parent that is not there");
  }
  require(parts.keyframes[0].parent == MapParts::kNone, "keyframe", 0, "is the root and has a parent");
}

void check_tree(const MapParts& parts) {
  // Upwards from every keyframe, as far as nobody has been yet: whoever meets this way's own mark goes round.
  std::vector<std::size_t> marks(parts.keyframes.size(), 0);
  for (std::size_t start = 0; start < marks.size(); ++start) {
    std::size_t at = start;
    while (marks[at] == 0 && parts.keyframes[at].parent != MapParts::kNone) {
      marks[at] = start + 1;
      at = parts.keyframes[at].parent;
    }
    require(marks[at] != start + 1, "keyframe", start, "is its own ancestor");
    if (marks[at] == 0) marks[at] = start + 1;
  }
}

void check_loops(const MapParts& parts) {
  for (std::size_t i = 0; i < parts.loops.size(); ++i) {
    const auto& [older, newer] = parts.loops[i];
    require(older < newer && newer < parts.keyframes.size(), "loop", i, "joins nothing");
  }
}

void check_points(const MapParts& parts) {
  std::vector<std::vector<bool>> taken;
  taken.reserve(parts.keyframes.size());
  for (const MapParts::KeyFramePart& keyframe : parts.keyframes) {
    taken.emplace_back(static_cast<std::size_t>(keyframe.features->size()), false);
  }
  std::vector<std::size_t> last_seen(parts.keyframes.size(), 0);  // position of the point, plus one
  for (std::size_t i = 0; i < parts.points.size(); ++i) {
    const MapParts::PointPart& point = parts.points[i];
    const auto must = [i](bool condition, const char* what) { require(condition, "point", i, what); };
    must(is_near(point.position_in_world), "has a position that is none");
    must(!point.observations.empty(), "is seen by nobody");
    for (const MapParts::ObservationPart& seen : point.observations) {
      must(seen.keyframe < taken.size() && seen.keypoint < taken[seen.keyframe].size(),
           "is seen by what is not there");
      must(last_seen[seen.keyframe] != i + 1, "is seen twice by one keyframe");
      must(!taken[seen.keyframe][seen.keypoint], "is seen by a keypoint that sees another point");
      taken[seen.keyframe][seen.keypoint] = true;
      last_seen[seen.keyframe] = i + 1;
    }
    must(point.reference < last_seen.size() && last_seen[point.reference] == i + 1,
         "has a reference that does not see it");
    must(point.first_sequence < parts.keyframes_created, "was made by a keyframe that never was");
    must(point.visible <= kMostCounted && point.found <= kMostCounted, "was seen too often");
  }
}

void check_frames(const MapParts& parts) {
  for (std::size_t i = 0; i < parts.frames.size(); ++i) {
    const MapParts::FramePart& frame = parts.frames[i];
    require(std::isfinite(frame.time_s), "frame", i, "has no time");
    require(frame.keyframe < parts.keyframes.size(), "frame", i, "hangs on a keyframe that is not there");
    require(is_rigid(frame.cam_from_keyframe), "frame", i, "has a pose that is none");
  }
}

}  // namespace

void check(const MapParts& parts, int n_levels) {
  if (parts.keyframes_created > kMostCreated || parts.points_created > kMostCreated)
    throw InputError("it has seen too much");
  check_keyframes(parts, n_levels);
  check_tree(parts);
  check_loops(parts);
  check_points(parts);
  check_frames(parts);
}

void check_sequences(const std::vector<MapParts>& sessions) {
  std::set<std::uint64_t> taken;
  std::uint64_t oldest = 0;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const std::uint64_t first = sessions[i].keyframes.front().sequence;
    require(first >= oldest, "session", i, "comes before the one in front of it");
    oldest = first;
    for (const MapParts::KeyFramePart& keyframe : sessions[i].keyframes)
      require(taken.insert(keyframe.sequence).second, "session", i, "has a keyframe that another one has");
  }
}

}  // namespace cpslam
