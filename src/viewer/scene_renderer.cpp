#include "viewer/scene_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "geometry/world_point.h"
#include "viewer/scene_shaders.h"

namespace cpslam::viewer {
namespace {

constexpr double kKeyFrameDepthM = 0.12;
constexpr double kCurrentDepthM = 0.3;
constexpr float kPointM = 0.022F;
constexpr double kArrowS = 0.6;  // the arrow of somebody's motion ends where he will be then

Eigen::Vector3f to_vector(Colour colour) {
  return Eigen::Vector3f(colour.red, colour.green, colour.blue) / 255.0F;
}

bool has_pose(const TrackResult& result) {
  return result.state != TrackingState::kNotInitialized && result.state != TrackingState::kLost;
}

WorldPoint centre_of(const std::vector<WorldPoint>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const WorldPoint& p : points) sum += Eigen::Vector3d(p[0], p[1], p[2]);
  return to_world_point(Eigen::Vector3d(sum / static_cast<double>(std::max<std::size_t>(points.size(), 1))));
}

Segment motion_arrow(const PersonShape& person, Colour colour) {
  const WorldPoint from = centre_of(person.surface);
  WorldPoint to = from;
  for (std::size_t i = 0; i < 3; ++i) to[i] += static_cast<float>(kArrowS) * person.velocity_m_per_s[i];
  return {{from, colour}, {to, colour}};
}

}  // namespace

SceneRenderer::SceneRenderer(const CameraSettings& camera)
    : camera_(camera),
      point_shader_(kPointVertexShader, kPointFragmentShader),
      line_shader_(kLineVertexShader, kLineFragmentShader) {}

void SceneRenderer::set_map(const MapSnapshot& map, const Eigen::Vector3d& up, const Trajectory& truth) {
  points_.set(height_coloured(map.points, up));
  keyframes_.set(frusta(map.keyframes, camera_, kKeyFrameDepthM, faded(kKeyFrame, 0.8)));
  covisibility_.set(edge_lines(map.covisibility, map.keyframes, faded(kCovisibility, 0.35)));
  spanning_tree_.set(edge_lines(map.spanning_tree, map.keyframes, kTree));
  loops_.set(edge_lines(map.loops, map.keyframes, kLoop));
  trajectory_.set(path(map.trajectory, kTrajectory));
  truth_.set(path(truth, kTruth));
}

void SceneRenderer::set_frame(const FrameSnapshot& frame) {
  tracked_points_.set(coloured(frame.tracked_points, kTracked));
  current_.set(has_pose(frame.result)
                   ? frustum(from_pose(frame.result.world_from_camera), camera_, kCurrentDepthM, kCamera)
                   : std::vector<Segment>());
  set_people(frame);
}

void SceneRenderer::set_people(const FrameSnapshot& frame) {
  std::vector<Vertex> surface;
  std::vector<Segment> motion;
  for (const PersonShape& person : frame.people) {
    const Colour colour = faded(person_colour(person.number), person.hidden ? 0.25 : 1.0);
    const std::vector<Vertex> his = coloured(person.surface, colour);
    surface.insert(surface.end(), his.begin(), his.end());
    motion.push_back(motion_arrow(person, colour));
    person_spacing_m_ = person.spacing_m;
  }
  people_.set(surface);
  motion_.set(motion);
}

void SceneRenderer::draw(const OrbitCamera& eye, const cv::Rect& area_px, double scale,
                         const Layers& layers) const {
  if (area_px.empty()) return;
  const double aspect = static_cast<double>(area_px.width) / area_px.height;
  glViewport(area_px.x, area_px.y, area_px.width, area_px.height);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_points(eye, area_px.height, aspect, scale, layers);
  glDepthMask(GL_FALSE);  // soft rims must not hide what is drawn later
  draw_lines(eye, area_px, scale, layers);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void SceneRenderer::draw_points(const OrbitCamera& eye, double height_px, double aspect, double scale,
                                const Layers& layers) const {
  const auto scale_f = static_cast<float>(scale);
  point_shader_.use();
  point_shader_.set("eye_from_world", eye.eye_from_world());
  point_shader_.set("clip_from_eye", eye.clip_from_eye(aspect));
  point_shader_.set("focal_px", static_cast<float>(OrbitCamera::focal_px(height_px)));
  point_shader_.set("fade_from_m", static_cast<float>(eye.distance_m()));
  point_shader_.set("background", to_vector(kBackground));
  point_shader_.set("least_px", 1.8F * scale_f);
  point_shader_.set("most_px", 7.0F * scale_f);
  point_shader_.set("size_m", kPointM);
  if (layers.points) {
    points_.draw();
    point_shader_.set("least_px", 3.0F * scale_f);
    tracked_points_.draw();
  }
  if (layers.people) {
    point_shader_.set("most_px", 60.0F * scale_f);
    point_shader_.set("size_m", 1.5F * person_spacing_m_);
    people_.draw();
  }
}

void SceneRenderer::draw_lines(const OrbitCamera& eye, const cv::Rect& area_px, double scale,
                               const Layers& layers) const {
  const double aspect = static_cast<double>(area_px.width) / area_px.height;
  line_shader_.use();
  line_shader_.set("clip_from_world", Eigen::Matrix4f(eye.clip_from_eye(aspect) * eye.eye_from_world()));
  line_shader_.set("viewport_px",
                   Eigen::Vector2f(static_cast<float>(area_px.width), static_cast<float>(area_px.height)));
  const auto draw = [&](bool shown, const SegmentStore& lines, double width_px) {
    if (!shown) return;
    line_shader_.set("width_px", static_cast<float>(scale * width_px));
    lines.draw();
  };
  draw(layers.covisibility, covisibility_, 1.0);
  draw(layers.spanning_tree, spanning_tree_, 1.5);
  draw(layers.keyframes, keyframes_, 1.2);
  draw(layers.loops, loops_, 2.5);
  draw(layers.truth, truth_, 2.0);
  draw(layers.trajectory, trajectory_, 2.0);
  draw(layers.people, motion_, 3.0);
  draw(true, current_, 2.5);
}

}  // namespace cpslam::viewer
