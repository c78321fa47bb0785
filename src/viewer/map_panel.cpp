#include "viewer/map_panel.h"

#include <string>

#include "viewer/widgets.h"

namespace cpslam::viewer {
namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav;

void draw_facts(const Gui& gui, const MapFacts& facts) {
  std::string line = grouped(facts.keyframes) + " keyframes     " + grouped(facts.points) + " points";
  if (facts.loops > 0) line += "     " + grouped(facts.loops) + (facts.loops == 1 ? " loop" : " loops");
  if (facts.people > 0) line += "     " + grouped(facts.people) + (facts.people == 1 ? " person" : " people");
  ImGui::TextUnformatted(line.c_str());
  if (!facts.ate_m) return;
  ImGui::PushFont(gui.small());
  dot(kTruth);
  quiet(text("%.1f mm RMSE off the ground truth", 1000.0 * *facts.ate_m));
  ImGui::PopFont();
}

void draw_views(ViewControl& view) {
  if (choice("Overview", view.mode() == ViewMode::kOverview, "The whole map (O)")) view.reset();
  ImGui::SameLine();
  if (choice("Follow", view.mode() == ViewMode::kFollow, "Around the camera (F)"))
    view.set_mode(ViewMode::kFollow);
  ImGui::SameLine();
  if (choice("Top", false, "From above (T)")) view.look_from_above();
}

void draw_layers(const MapFacts& facts, Layers& layers) {
  layer_switch("Points", height_colour(0.75), layers.points);
  layer_switch("Keyframes", kKeyFrame, layers.keyframes);
  layer_switch("Covisibility", {110, 150, 215}, layers.covisibility);
  layer_switch("Spanning tree", kTree, layers.spanning_tree);
  layer_switch("Loops", kLoop, layers.loops);
  layer_switch("Trajectory", kTrajectory, layers.trajectory);
  if (facts.has_truth) layer_switch("Ground truth", kTruth, layers.truth);
  layer_switch("People", person_colour(2), layers.people);
  layer_switch("Floor", kQuietText, layers.grid);
}

void draw_run_buttons(const RunFacts& run, PanelWishes& wishes) {
  if (run.can_pause) {
    wishes.pause = choice(run.paused ? "Go on" : "Pause", run.paused, "Space");
    ImGui::SameLine();
    wishes.step = choice("Step", false, "The next frame, then pause (N)");
    ImGui::SameLine();
  }
  wishes.localization = choice("Localise only", run.localizing,
                               run.localizing ? "Map again (L)" : "Leave the map as it is from now on (L)");
  ImGui::SameLine();
  wishes.reset = choice(run.reset_armed ? "Drop the map?" : "Reset map", run.reset_armed,
                        run.reset_armed ? "Once more to do it (R)"
                                        : "Start a new map; the poses so far are kept in a file (R, twice)");
  ImGui::SameLine();
}

}  // namespace

void draw_map_panel(const Gui& gui, const MapFacts& facts, ImVec2 corner, ImVec2 size, Layers& layers,
                    ViewControl& view) {
  const float margin = 14.0F * gui.scale();
  ImGui::SetNextWindowPos({corner.x + margin, corner.y + margin});
  ImGui::Begin("map facts", nullptr, kOverlay | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoInputs);
  draw_facts(gui, facts);
  ImGui::End();
  ImGui::SetNextWindowPos({corner.x + size.x - margin, corner.y + margin}, ImGuiCond_Always, {1.0F, 0.0F});
  ImGui::Begin("layers", nullptr, kOverlay);
  draw_views(view);
  ImGui::Separator();
  draw_layers(facts, layers);
  ImGui::End();
}

PanelWishes draw_play_panel(const Gui& gui, const RunFacts& run, ImVec2 corner, ImVec2 size) {
  PanelWishes wishes;
  const float margin = 14.0F * gui.scale();
  ImGui::SetNextWindowPos({corner.x + size.x - margin, corner.y + size.y - margin}, ImGuiCond_Always,
                          {1.0F, 1.0F});
  ImGui::Begin("play", nullptr, kOverlay);
  if (run.ended) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("The run has ended");
    ImGui::SameLine();
  } else {
    draw_run_buttons(run, wishes);
  }
  wishes.screenshot = choice("Screenshot", false, "Into the output folder (S)");
  ImGui::End();
  return wishes;
}

}  // namespace cpslam::viewer
