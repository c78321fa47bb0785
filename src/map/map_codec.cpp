#include "map/map_codec.h"

#include <memory>
#include <utility>

namespace cpslam {
namespace {

constexpr std::size_t kPoseSize = 12 * sizeof(double);
constexpr std::size_t kFeatureSize = 4 * sizeof(float) + 1 + sizeof(Descriptor) + 2 * sizeof(float);
constexpr std::size_t kMinKeyFrameSize = 8 + 8 + kPoseSize + 4 + 4;
constexpr std::size_t kLoopSize = 4 + 4;
constexpr std::size_t kObservationSize = 4 + 4;
constexpr std::size_t kMinPointSize = 3 * sizeof(double) + 4 + 8 + 4 + 4 + 4;
constexpr std::size_t kFrameSize = 8 + 4 + kPoseSize;

void write_count(std::size_t n, ByteWriter& writer) {
  writer.u32(static_cast<std::uint32_t>(n));
}

void write_vector(const Eigen::Vector3d& vector, ByteWriter& writer) {
  for (Eigen::Index i = 0; i < 3; ++i) writer.f64(vector(i));
}

Eigen::Vector3d read_vector(ByteReader& reader) {
  Eigen::Vector3d vector;
  for (Eigen::Index i = 0; i < 3; ++i) vector(i) = reader.f64();
  return vector;
}

void write_pose(const SE3& pose, ByteWriter& writer) {
  for (Eigen::Index row = 0; row < 3; ++row) write_vector(pose.rotation.row(row), writer);
  write_vector(pose.translation, writer);
}

SE3 read_pose(ByteReader& reader) {
  SE3 pose;
  for (Eigen::Index row = 0; row < 3; ++row) pose.rotation.row(row) = read_vector(reader);
  pose.translation = read_vector(reader);
  return pose;
}

void write_features(const FrameFeatures& features, ByteWriter& writer) {
  write_count(features.keypoints.size(), writer);
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const Keypoint& keypoint = features.keypoints[i];
    writer.f32(keypoint.x);
    writer.f32(keypoint.y);
    writer.f32(keypoint.angle_deg);
    writer.f32(keypoint.response);
    writer.u8(static_cast<std::uint8_t>(keypoint.octave));
    for (const std::uint64_t word : features.descriptors[i].words) writer.u64(word);
    writer.f32(features.depth_m[i]);
    writer.f32(features.depth_sigma_m[i]);
  }
}

std::shared_ptr<const FrameFeatures> read_features(ByteReader& reader, const PinholeCamera& camera) {
  auto features = std::make_shared<FrameFeatures>();
  const std::size_t n = reader.count(kFeatureSize);
  features->keypoints.resize(n);
  features->descriptors.resize(n);
  features->depth_m.resize(n);
  features->depth_sigma_m.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Keypoint& keypoint = features->keypoints[i];
    keypoint.x = reader.f32();
    keypoint.y = reader.f32();
    keypoint.angle_deg = reader.f32();
    keypoint.response = reader.f32();
    keypoint.octave = reader.u8();
    for (std::uint64_t& word : features->descriptors[i].words) word = reader.u64();
    features->depth_m[i] = reader.f32();
    features->depth_sigma_m[i] = reader.f32();
  }
  derive(*features, camera);
  return features;
}

void write_keyframe(const MapParts::KeyFramePart& keyframe, ByteWriter& writer) {
  writer.u64(keyframe.sequence);
  writer.f64(keyframe.time_s);
  write_pose(keyframe.cam_from_world, writer);
  writer.u32(keyframe.parent);
  write_features(*keyframe.features, writer);
}

MapParts::KeyFramePart read_keyframe(ByteReader& reader, const PinholeCamera& camera) {
  MapParts::KeyFramePart keyframe;
  keyframe.sequence = reader.u64();
  keyframe.time_s = reader.f64();
  keyframe.cam_from_world = read_pose(reader);
  keyframe.parent = reader.u32();
  keyframe.features = read_features(reader, camera);
  return keyframe;
}

void write_point(const MapParts::PointPart& point, ByteWriter& writer) {
  write_vector(point.position_in_world, writer);
  writer.u32(point.reference);
  writer.u64(point.first_sequence);
  writer.u32(point.visible);
  writer.u32(point.found);
  write_count(point.observations.size(), writer);
  for (const MapParts::ObservationPart& seen : point.observations) {
    writer.u32(seen.keyframe);
    writer.u32(seen.keypoint);
  }
}

MapParts::PointPart read_point(ByteReader& reader) {
  MapParts::PointPart point;
  point.position_in_world = read_vector(reader);
  point.reference = reader.u32();
  point.first_sequence = reader.u64();
  point.visible = reader.u32();
  point.found = reader.u32();
  point.observations.resize(reader.count(kObservationSize));
  for (MapParts::ObservationPart& seen : point.observations) {
    seen.keyframe = reader.u32();
    seen.keypoint = reader.u32();
  }
  return point;
}

}  // namespace

void write_session(const MapParts& parts, ByteWriter& writer) {
  writer.u64(parts.keyframes_created);
  writer.u64(parts.points_created);
  write_count(parts.keyframes.size(), writer);
  for (const MapParts::KeyFramePart& keyframe : parts.keyframes) write_keyframe(keyframe, writer);
  write_count(parts.loops.size(), writer);
  for (const auto& [older, newer] : parts.loops) {
    writer.u32(older);
    writer.u32(newer);
  }
  write_count(parts.points.size(), writer);
  for (const MapParts::PointPart& point : parts.points) write_point(point, writer);
  write_count(parts.frames.size(), writer);
  for (const MapParts::FramePart& frame : parts.frames) {
    writer.f64(frame.time_s);
    writer.u32(frame.keyframe);
    write_pose(frame.cam_from_keyframe, writer);
  }
}

MapParts read_session(ByteReader& reader, const PinholeCamera& camera) {
  MapParts parts;
  parts.keyframes_created = reader.u64();
  parts.points_created = reader.u64();
  const std::size_t n_keyframes = reader.count(kMinKeyFrameSize);
  parts.keyframes.reserve(n_keyframes);
  for (std::size_t i = 0; i < n_keyframes; ++i) parts.keyframes.push_back(read_keyframe(reader, camera));
  parts.loops.resize(reader.count(kLoopSize));
  for (auto& [older, newer] : parts.loops) {
    older = reader.u32();
    newer = reader.u32();
  }
  const std::size_t n_points = reader.count(kMinPointSize);
  parts.points.reserve(n_points);
  for (std::size_t i = 0; i < n_points; ++i) parts.points.push_back(read_point(reader));
  parts.frames.resize(reader.count(kFrameSize));
  for (MapParts::FramePart& frame : parts.frames) {
    frame.time_s = reader.f64();
    frame.keyframe = reader.u32();
    frame.cam_from_keyframe = read_pose(reader);
  }
  return parts;
}

}  // namespace cpslam
