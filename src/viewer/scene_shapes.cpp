#include "viewer/scene_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/world_point.h"
#include "io/trajectory_error.h"

namespace cpslam::viewer {
namespace {

constexpr std::size_t kEnoughToAlign = 30;  // poses; fewer make the truth jump about

WorldPoint position(const StampedPose& pose) {
  const auto& t = pose.world_from_camera.translation_m;
  return to_world_point(Eigen::Vector3d(t[0], t[1], t[2]));
}

float height(const WorldPoint& point, const Eigen::Vector3f& up) {
  return up.dot(Eigen::Vector3f(point.data()));
}

/// Heights between which nearly all points lie.
std::pair<float, float> height_range(const std::vector<WorldPoint>& points, const Eigen::Vector3f& up) {
  std::vector<float> heights;
  heights.reserve(points.size());
  for (const WorldPoint& point : points) heights.push_back(height(point, up));
  const auto at = [&heights](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), heights.begin() + rank, heights.end());
    return heights[static_cast<std::size_t>(rank)];
  };
  const float low = at(0.03);
  return {low, std::max(at(0.97), low + 0.01F)};
}

void append_frustum(const SE3& world_from_camera, const CameraSettings& camera, double depth_m, Colour colour,
                    std::vector<Segment>& segments) {
  const auto corner = [&](double x, double y) {
    const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
    return Vertex{to_world_point(world_from_camera * Eigen::Vector3d(depth_m * ray)), colour};
  };
  const double width = camera.width;
  const double height = camera.height;
  const std::array<Vertex, 4> corners{corner(0, 0), corner(width, 0), corner(width, height),
                                      corner(0, height)};
  const Vertex apex{to_world_point(world_from_camera.translation), colour};
  for (std::size_t i = 0; i < 4; ++i) {
    segments.push_back({apex, corners[i]});
    segments.push_back({corners[i], corners[(i + 1) % 4]});
  }
}

}  // namespace

std::vector<Vertex> height_coloured(const std::vector<WorldPoint>& points, const Eigen::Vector3d& up) {
  std::vector<Vertex> vertices;
  if (points.empty()) return vertices;
  const Eigen::Vector3f up_f = up.cast<float>();
  const auto [low, high] = height_range(points, up_f);
  vertices.reserve(points.size());
  for (const WorldPoint& point : points) {
    vertices.push_back({point, height_colour((height(point, up_f) - low) / (high - low))});
  }
  return vertices;
}

std::vector<Vertex> coloured(const std::vector<WorldPoint>& points, Colour colour) {
  std::vector<Vertex> vertices;
  vertices.reserve(points.size());
  for (const WorldPoint& point : points) vertices.push_back({point, colour});
  return vertices;
}

std::vector<Segment> frustum(const SE3& world_from_camera, const CameraSettings& camera, double depth_m,
                             Colour colour) {
  std::vector<Segment> segments;
  append_frustum(world_from_camera, camera, depth_m, colour, segments);
  return segments;
}

std::vector<Segment> frusta(const Trajectory& poses, const CameraSettings& camera, double depth_m,
                            Colour colour) {
  std::vector<Segment> segments;
  segments.reserve(8 * poses.size());
  for (const StampedPose& pose : poses)
    append_frustum(from_pose(pose.world_from_camera), camera, depth_m, colour, segments);
  return segments;
}

std::vector<Segment> edge_lines(const std::vector<KeyFrameEdge>& edges, const Trajectory& keyframes,
                                Colour colour) {
  std::vector<Segment> segments;
  segments.reserve(edges.size());
  for (const KeyFrameEdge& edge : edges) {
    segments.push_back(
        {{position(keyframes.at(edge.from)), colour}, {position(keyframes.at(edge.to)), colour}});
  }
  return segments;
}

std::vector<Segment> path(const Trajectory& trajectory, Colour colour, double max_gap_s) {
  std::vector<Segment> segments;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].time_s - trajectory[i - 1].time_s > max_gap_s) continue;
    segments.push_back({{position(trajectory[i - 1]), colour}, {position(trajectory[i]), colour}});
  }
  return segments;
}

Trajectory aligned_truth(const Trajectory& truth, const Trajectory& estimate) {
  Trajectory aligned;
  if (estimate.size() < kEnoughToAlign) return aligned;
  const std::optional<SE3> estimate_from_truth = align_to_estimate(truth, estimate);
  if (!estimate_from_truth) return aligned;
  for (const StampedPose& pose : truth) {
    if (pose.time_s < estimate.front().time_s || pose.time_s > estimate.back().time_s) continue;
    aligned.push_back({pose.time_s, to_pose(*estimate_from_truth * from_pose(pose.world_from_camera))});
  }
  return aligned;
}

}  // namespace cpslam::viewer
