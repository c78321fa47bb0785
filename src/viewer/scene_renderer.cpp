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

/// Whether OpenGL is Mesa's in software, on the cores that tracking needs.
bool drawn_by_processor() {
  const auto* const name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name != nullptr ? name : "";
  return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

Eigen::Vector3f to_vector(Colour colour) {
  return Eigen::Vector3f(colour.red, colour.green, colour.blue) / 255.0F;
}

bool has_pose(const TrackResult& result) {
  return result.state != TrackingState::kNotInitialized && result.state != TrackingState::kLost;
}

}  // namespace

/// Size in the world and its bounds in the window.
struct SceneRenderer::PointLook {
  float size_m, least_px, most_px;
};

SceneRenderer::SceneRenderer(const CameraSettings& camera)
    : camera_(camera),
      most_points_(drawn_by_processor() ? kMostPointsByProcessor : std::numeric_limits<std::size_t>::max()),
      square_shader_(kPointVertexShader, kSquareFragmentShader),
      round_shader_(kPointVertexShader, kRoundFragmentShader),
      line_shader_(kLineVertexShader, kLineFragmentShader) {}

void SceneRenderer::set_map(const MapSnapshot& map, const Eigen::Vector3d& up, const Trajectory& truth) {
  up_ = up;
  pictured_.reset();
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
                         const Layers& layers) {
  if (area_px.empty()) return;
  const double aspect = static_cast<double>(area_px.width) / area_px.height;
  const View view{eye.eye_from_world(),
                  eye.clip_from_eye(aspect),
                  static_cast<float>(OrbitCamera::focal_px(area_px.height)),
                  static_cast<float>(eye.distance_m()),
                  area_px.size(),
                  scale,
                  layers};
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  if (pictured_ != view) {
    map_picture_.begin(view.size);
    draw_map(view);
    map_picture_.end();
    pictured_ = view;
  }
  map_picture_.show(area_px.tl());
  glViewport(area_px.x, area_px.y, area_px.width, area_px.height);
  draw_frame(view);
  glDisable(GL_DEPTH_TEST);
}

void SceneRenderer::draw_map(const View& view) {
  const Layers& layers = view.layers;
  glViewport(0, 0, view.size.width, view.size.height);
  const Eigen::Vector3f background = to_vector(kBackground);
  glClearColor(background.x(), background.y(), background.z(), 1.0F);
  glClear(static_cast<GLbitfield>(GL_COLOR_BUFFER_BIT) | static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT));
  glDisable(GL_BLEND);
  const ShaderProgram& shader = points_.size() > kManyPoints ? square_shader_ : round_shader_;
  if (layers.points) draw_points(view, shader, points_, {kPointM, 2.0F, 7.0F});
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);  // soft rims must not hide what is drawn later
  begin_lines(view);
  if (layers.grid) draw_lines(view, grid_, 1.0);
  if (layers.covisibility) draw_lines(view, covisibility_, 1.0);
  if (layers.spanning_tree) draw_lines(view, spanning_tree_, 1.5);
  if (layers.keyframes) draw_lines(view, keyframes_, 1.2);
  if (layers.loops) draw_lines(view, loops_, 2.5);
  if (layers.truth) draw_lines(view, truth_, 2.0);
  if (layers.trajectory) draw_lines(view, trajectory_, 2.0);
  glDepthMask(GL_TRUE);
}

void SceneRenderer::draw_frame(const View& view) const {
  glEnable(GL_BLEND);  // who is hidden is seen through
  if (view.layers.points) draw_points(view, square_shader_, tracked_points_, {kPointM, 3.0F, 7.0F});
  if (view.layers.people) draw_points(view, round_shader_, people_, {2.2F * person_spacing_m_, 3.0F, 60.0F});
  glDepthMask(GL_FALSE);
  begin_lines(view);
  if (view.layers.people) draw_lines(view, motion_, 3.0);
  draw_lines(view, current_, 2.5);
  glDepthMask(GL_TRUE);
}

void SceneRenderer::draw_points(const View& view, const ShaderProgram& shader, const PointStore& points,
                                const PointLook& look) const {
  const auto px = static_cast<float>(view.scale);
  shader.use();
  shader.set("eye_from_world", view.eye_from_world);
  shader.set("clip_from_eye", view.clip_from_eye);
  shader.set("focal_px", view.focal_px);
  shader.set("fade_from_m", view.distance_m);
  shader.set("background", to_vector(kBackground));
  shader.set("size_m", look.size_m);
  shader.set("least_px", px * look.least_px);
  shader.set("most_px", px * look.most_px);
  points.draw();
}

void SceneRenderer::begin_lines(const View& view) const {
  line_shader_.use();
  line_shader_.set("clip_from_world", Eigen::Matrix4f(view.clip_from_eye * view.eye_from_world));
  line_shader_.set("viewport_px", Eigen::Vector2f(static_cast<float>(view.size.width),
                                                  static_cast<float>(view.size.height)));
}

void SceneRenderer::draw_lines(const View& view, const SegmentStore& lines, double width_px) const {
  line_shader_.set("width_px", static_cast<float>(view.scale * width_px));
  lines.draw();
}

}  // namespace cpslam::viewer
