#include "viewer/scene_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "viewer/scene_shaders.h"

namespace cpslam::viewer {
namespace {

constexpr double kKeyFrameDepthM = 0.12;
constexpr double kLeastCurrentDepthM = 0.3;
constexpr double kCurrentShare = 0.06;  // of the radius of the map, to be found in it
constexpr float kPointM = 0.03F;
constexpr std::size_t kManyPoints = 15000;
constexpr std::size_t kMostPointsByProcessor = 40000;  // a pixel of a window shows but one
constexpr float kInFront = 0.001F;                     // of the depth: before another point at the same place

/// Whether OpenGL is Mesa's in software, on the cores that tracking needs.
bool drawn_by_processor() {
  const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name != nullptr ? name : "";
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

/// Size in the world, its bounds in the window, and by which share of the depth it counts as nearer.
struct PointLook {
  float size_m, least_px, most_px, nearer;
};

Eigen::Vector3f to_vector(Colour colour) {
  return Eigen::Vector3f(colour.red, colour.green, colour.blue) / 255.0F;
}

bool has_pose(const TrackResult& result) {
  return result.state != TrackingState::kNotInitialized && result.state != TrackingState::kLost;
}

}  // namespace

SceneRenderer::SceneRenderer(const CameraSettings& camera)
    : camera_(camera),
      most_points_(drawn_by_processor() ? kMostPointsByProcessor : std::numeric_limits<std::size_t>::max()),
      square_shader_(kPointVertexShader, kSquareFragmentShader),
      round_shader_(kPointVertexShader, kRoundFragmentShader),
      line_shader_(kLineVertexShader, kLineFragmentShader) {}

void SceneRenderer::set_map(const MapSnapshot& map, const Eigen::Vector3d& up, const Trajectory& truth) {
  up_ = up;
  const std::optional<Extent> extent = extent_of(map, up);
  if (extent) current_depth_m_ = std::max(kLeastCurrentDepthM, kCurrentShare * extent->radius_m);
  grid_.set(extent ? floor_grid(*extent, up, faded(kQuietText, 0.3)) : std::vector<Segment>());
  points_.set(height_coloured(thinned(map.points, most_points_), up));
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
                   ? frustum(from_pose(frame.result.world_from_camera), camera_, current_depth_m_, kCamera)
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
    const std::vector<Segment> arrow = motion_arrow(person, up_, colour);
    motion.insert(motion.end(), arrow.begin(), arrow.end());
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
  glDisable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_points(eye, area_px.height, aspect, scale, layers);
  glDepthMask(GL_FALSE);  // soft rims must not hide what is drawn later
  draw_lines(eye, area_px, scale, layers);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void SceneRenderer::draw_points(const OrbitCamera& eye, double height_px, double aspect, double scale,
                                const Layers& layers) const {
  const auto draw = [&](bool shown, const ShaderProgram& shader, const PointStore& points,
                        const PointLook& look) {
    if (!shown) return;
    const auto px = static_cast<float>(scale);
    shader.use();
    shader.set("eye_from_world", eye.eye_from_world());
    shader.set("clip_from_eye", eye.clip_from_eye(aspect));
    shader.set("focal_px", static_cast<float>(OrbitCamera::focal_px(height_px)));
    shader.set("fade_from_m", static_cast<float>(eye.distance_m()));
    shader.set("background", to_vector(kBackground));
    shader.set("size_m", look.size_m);
    shader.set("least_px", px * look.least_px);
    shader.set("most_px", px * look.most_px);
    shader.set("nearer", look.nearer);
    points.draw();
  };
  const ShaderProgram& shader = points_.size() > kManyPoints ? square_shader_ : round_shader_;
  draw(layers.points, shader, points_, {kPointM, 2.0F, 7.0F, 0.0F});
  draw(layers.points, shader, tracked_points_, {kPointM, 3.0F, 7.0F, kInFront});
  glEnable(GL_BLEND);  // who is hidden is seen through
  draw(layers.people, round_shader_, people_, {2.2F * person_spacing_m_, 3.0F, 60.0F, 0.0F});
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
  draw(layers.grid, grid_, 1.0);
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
