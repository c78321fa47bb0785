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
constexpr double kMostLines = 60.0;         // of the grid, to each side
constexpr double kArrowS = 0.6;             // an arrow ends where somebody will be then
constexpr double kShortestArrowM = 0.05;
constexpr double kShortestStepM = 0.01;  // of a path: a resting camera would draw thousands of lines

WorldPoint position(const StampedPose& pose) {
  const auto& t = pose.world_from_camera.translation_m;
  return to_world_point(Eigen::Vector3d(t[0], t[1], t[2]));
}

double distance_m(const WorldPoint& a, const WorldPoint& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
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

std::vector<WorldPoint> thinned(const std::vector<WorldPoint>& points, std::size_t most) {
  if (points.size() <= most) return points;
  const std::size_t step = (points.size() + most - 1) / most;
  std::vector<WorldPoint> some;
  some.reserve(points.size() / step + 1);
  for (std::size_t i = 0; i < points.size(); i += step) some.push_back(points[i]);
  return some;
}

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

std::vector<Segment> floor_grid(const Extent& extent, const Eigen::Vector3d& up, Colour colour) {
  const auto n = static_cast<int>(std::min(kMostLines, std::ceil(1.2 * extent.radius_m)));
  const Eigen::Vector3d right = up.unitOrthogonal();
  const Eigen::Vector3d ahead = up.cross(right);
  // Whole metres, so that the lines stand still while the map grows.
  const double right_m = std::round(right.dot(extent.centre));
  const double ahead_m = std::round(ahead.dot(extent.centre));
  const auto vertex = [&](int i, int j) {
    const double off = std::hypot(i, j) / (n + 1.0);
    const Eigen::Vector3d p = (right_m + i) * right + (ahead_m + j) * ahead + extent.floor_m * up;
    return Vertex{to_world_point(p), faded(colour, std::max(0.0, 1.0 - off))};
  };
  std::vector<Segment> segments;
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j < n; ++j) {
      segments.push_back({vertex(i, j), vertex(i, j + 1)});
      segments.push_back({vertex(j, i), vertex(j + 1, i)});
    }
  }
  return segments;
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

std::vector<Segment> motion_arrow(const PersonShape& person, const Eigen::Vector3d& up, Colour colour) {
  const auto& v = person.velocity_m_per_s;
  const Eigen::Vector3d way = kArrowS * Eigen::Vector3d(v[0], v[1], v[2]);
  if (person.surface.empty() || way.norm() < kShortestArrowM) return {};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  for (const WorldPoint& p : person.surface) from += Eigen::Vector3d(p[0], p[1], p[2]);
  from /= static_cast<double>(person.surface.size());
  const Eigen::Vector3d tip = from + way;
  const Eigen::Vector3d back = -0.3 * way;
  const Eigen::Vector3d aside = 0.6 * back.cross(up);
  const auto vertex = [colour](const Eigen::Vector3d& p) { return Vertex{to_world_point(p), colour}; };
  return {{vertex(from), vertex(tip)},
          {vertex(tip), vertex(tip + back + aside)},
          {vertex(tip), vertex(tip + back - aside)}};
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
  if (trajectory.empty()) return segments;
  WorldPoint from = position(trajectory.front());
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const WorldPoint to = position(trajectory[i]);
    const bool gap = trajectory[i].time_s - trajectory[i - 1].time_s > max_gap_s;
    const bool ends =
        i + 1 == trajectory.size() || trajectory[i + 1].time_s - trajectory[i].time_s > max_gap_s;
    if (!gap && !ends && distance_m(from, to) < kShortestStepM) continue;
    if (!gap) segments.push_back({{from, colour}, {to, colour}});
    from = to;
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
