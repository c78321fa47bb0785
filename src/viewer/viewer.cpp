#include "viewer/viewer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "geometry/se3.h"
#include "io/trajectory_error.h"
#include "viewer/timing_panel.h"
#include "viewer/widgets.h"
#include "viewer/window_picture.h"

namespace cpslam::viewer {
namespace {

constexpr int kSettlingDraws = 3;
constexpr double kLookS = 0.005;  // how often somebody looks for new snapshots; a look costs microseconds
constexpr double kMapsPerS = 4.0;
constexpr double kResetS = 4.0;       // for the second press
constexpr float kColumnShare = 0.4F;  // of the window's width, for the camera's column

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Far cheaper than a window's ground drawn by ImGui where the processor does the drawing, and than a clear
/// for each of the window's parts.
void clear(Colour colour) {
  glClearColor(colour.red / 255.0F, colour.green / 255.0F, colour.blue / 255.0F, 1.0F);
  glClear(static_cast<GLbitfield>(GL_COLOR_BUFFER_BIT) | static_cast<GLbitfield>(GL_DEPTH_BUFFER_BIT));
}

}  // namespace

Viewer::Viewer(ViewerOptions options, std::shared_ptr<SnapshotBoard> board, RunControl& control)
    : options_(std::move(options)),
      board_(std::move(board)),
      control_(control),
      window_("CP-SLAM", options_.size),
      gui_(window_),
      scene_(options_.camera) {
  facts_.has_truth = !options_.truth.empty();
  request_snapshots();
}

void Viewer::run(const std::function<bool()>& run_ended, const std::function<bool()>& interrupted) {
  while (!window_.close_requested() && !interrupted()) {
    const double due_s = std::clamp(1.0 / kMaxPerS - seconds_since(drawn_), 0.001, kLookS);
    window_.wait_for_events(stale_draws_ > 0 ? due_s : (ended_ ? 1.0 / kMaxPerS : kLookS));
    // Asked before the snapshots are taken, so that the last ones are seen.
    const bool ended = run_ended();
    const bool fresh = take_snapshots() || ended != ended_;
    ended_ = ended;
    disarm_reset();
    handle_keys();
    if (fresh || window_.take_activity()) stale_draws_ = kSettlingDraws;
    if (!is_due()) continue;
    draw();
    if (ended && !options_.final_picture.empty() && stale_draws_ == 0) {
      save_drawn(options_.final_picture, window_.frame_size());
      break;
    }
    window_.show_drawn();
  }
  control_.quit();
}

void Viewer::draw_once() {
  window_.wait_for_events(1e-6);
  take_snapshots();
  draw();
  glFinish();
  window_.show_drawn();
}

bool Viewer::is_due() const {
  const double since_s = seconds_since(drawn_);
  return (new_frame_ && since_s >= 1.0 / kMaxNewPerS) || (stale_draws_ > 0 && since_s >= 1.0 / kMaxPerS);
}

bool Viewer::take_snapshots() {
  bool fresh = false;
  if (auto map = board_->map(); map != nullptr && map != map_) {
    map_ = std::move(map);
    take_map(*map_);
    fresh = true;
  }
  if (auto frame = board_->frame(); frame != nullptr && frame != frame_) {
    frame_ = std::move(frame);
    camera_panel_.set_frame(frame_);
    scene_.set_frame(*frame_);
    timings_.add(*frame_);
    facts_.people = frame_->people.size();
    const SE3 camera = from_pose(frame_->result.world_from_camera);
    if (is_tracked(frame_->result.state))
      view_.set_camera(camera.translation, camera.rotation * Eigen::Vector3d::UnitZ());
    if (!control_.wishes().localization) wished_localization_.reset();
    new_frame_ = fresh = true;
  }
  request_snapshots();
  return fresh;
}

void Viewer::take_map(const MapSnapshot& map) {
  map_taken_ = Clock::now();
  scene_.set_map(map, up_of(map), aligned_truth(options_.truth, map.trajectory));
  view_.set_map(map);
  facts_.keyframes = map.keyframes.size();
  facts_.points = map.points.size();
  facts_.loops = map.loops.size();
  const TrajectoryError error = absolute_trajectory_error(options_.truth, map.trajectory);
  facts_.ate_m = error.pairs >= 3 ? std::optional(error.rmse_m) : std::nullopt;
}

void Viewer::request_snapshots() {
  const bool stepping = control_.paused();
  // The picture at the end is to be of the very last frame; the last map comes in any case.
  const bool every_frame = stepping || !options_.final_picture.empty();
  board_->request_frame(every_frame ? SnapshotWish::kEvery : SnapshotWish::kWhenCheap);
  if (stepping) {
    board_->request_map(SnapshotWish::kEvery);
  } else if (map_ == nullptr || seconds_since(map_taken_) > 1.0 / kMapsPerS) {
    board_->request_map(SnapshotWish::kWhenCheap);
  }
}

void Viewer::handle_keys() {
  for (const char key : window_.take_keys()) {
    switch (key) {
      case ' ':
        if (options_.can_pause) pause_or_go_on();
        break;
      case 'N':
        if (options_.can_pause) step();
        break;
      case 'L':
        switch_localization();
        break;
      case 'R':
        reset_map();
        break;
      case 'S':
        wants_screenshot_ = true;
        break;
      case 'O':
        view_.reset();
        break;
      case 'F':
        view_.set_mode(ViewMode::kFollow);
        break;
      case 'T':
        view_.look_from_above();
        break;
      case 'Q':
      case '\x1b':
        window_.request_close();
        break;
      default:
        break;
    }
  }
}

void Viewer::pause_or_go_on() {
  control_.paused() ? control_.resume() : control_.pause();
  request_snapshots();
}

void Viewer::step() {
  control_.pause();
  request_snapshots();  // before the frame is taken, so that it is shown
  control_.step();
}

RunFacts Viewer::run_facts() const {
  RunFacts facts;
  facts.can_pause = options_.can_pause;
  facts.paused = control_.paused();
  facts.localizing = wished_localization_.value_or(frame_ ? frame_->localization : options_.localization);
  facts.reset_armed = reset_armed_.has_value();
  facts.ended = ended_;
  return facts;
}

void Viewer::switch_localization() {
  if (ended_) return;
  wished_localization_ = !run_facts().localizing;
  control_.wish_localization(*wished_localization_);
}

void Viewer::reset_map() {
  if (ended_) return;
  if (reset_armed_) {
    control_.wish_reset();
    reset_armed_.reset();
  } else {
    reset_armed_ = Clock::now();
  }
}

void Viewer::disarm_reset() {
  if (!reset_armed_ || seconds_since(*reset_armed_) < kResetS) return;
  reset_armed_.reset();
  stale_draws_ = kSettlingDraws;
}

void Viewer::handle_mouse() {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantCaptureMouse) return;
  const bool moved = io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F;
  if (moved && ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
    view_.turn(io.MouseDelta.x, io.MouseDelta.y);
  } else if (moved &&
             (ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
              ImGui::IsMouseDown(ImGuiMouseButton_Middle))) {
    view_.pan(io.MouseDelta.x, io.MouseDelta.y, io.DisplaySize.y);
  }
  if (io.MouseWheel != 0.0F) view_.zoom(io.MouseWheel);
}

ImVec2 Viewer::map_corner() const {
  return {std::round(kColumnShare * ImGui::GetIO().DisplaySize.x), 0.0F};
}

void Viewer::draw() {
  new_frame_ = false;
  stale_draws_ = std::max(0, stale_draws_ - 1);
  const double dt_s = std::min(0.2, seconds_since(drawn_));
  drawn_ = Clock::now();
  gui_.begin_frame();
  handle_mouse();
  lay_out();
  const cv::Size size = window_.frame_size();
  const int column = static_cast<int>(std::lround(window_.pixel_ratio() * map_corner().x));
  const cv::Rect map_area(column, 0, std::max(0, size.width - column), size.height);
  if (!map_area.empty()) view_.set_aspect(static_cast<double>(map_area.width) / map_area.height);
  if (view_.glide(dt_s)) stale_draws_ = std::max(stale_draws_, 1);
  clear(kPanel);
  scene_.draw(view_.eye(), map_area, window_.pixel_ratio() * gui_.scale(), layers_);
  glViewport(0, 0, size.width, size.height);
  gui_.draw_frame();
  if (std::exchange(wants_screenshot_, false)) save_screenshot();
}

void Viewer::lay_out() {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const ImVec2 corner = map_corner();
  ImGui::SetNextWindowPos({0.0F, 0.0F});
  ImGui::SetNextWindowSize({corner.x, whole.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  ImGui::Begin("camera", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar();
  camera_panel_.draw(gui_);
  ImGui::Separator();
  draw_timings(gui_, timings_);
  ImGui::End();
  const ImVec2 size(whole.x - corner.x, whole.y);
  draw_map_panel(gui_, facts_, corner, size, layers_, view_);
  const PanelWishes wishes = draw_play_panel(gui_, run_facts(), corner, size);
  if (wishes.pause) pause_or_go_on();
  if (wishes.step) step();
  if (wishes.localization) switch_localization();
  if (wishes.reset) reset_map();
  wants_screenshot_ |= wishes.screenshot;
}

void Viewer::save_screenshot() {
  const std::uint64_t index = frame_ ? frame_->index : 0;
  const std::string name = text("viewer-%06llu.png", static_cast<unsigned long long>(index));
  save_drawn((std::filesystem::path(options_.screenshot_folder) / name).string(), window_.frame_size());
}

}  // namespace cpslam::viewer
