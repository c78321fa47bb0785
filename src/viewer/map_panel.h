#pragma once

#include <cstddef>
#include <optional>

#include "viewer/gui.h"
#include "viewer/scene_renderer.h"
#include "viewer/view_control.h"

namespace cpslam::viewer {

/// What is said of the map in words.
struct MapFacts {
  std::size_t keyframes = 0;
  std::size_t points = 0;
  std::size_t loops = 0;
  std::size_t people = 0;
  std::optional<double> ate_m;  ///< RMSE against the ground truth
  bool has_truth = false;
};

/// How the run stands, as its buttons show it.
struct RunFacts {
  bool can_pause = true;  ///< not with a live camera
  bool paused = false;
  bool localizing = false;
  bool reset_armed = false;  ///< one more press drops the map
  bool ended = false;        ///< no more frames come
};

/// What the panels can ask for.
struct PanelWishes {
  bool pause = false;  ///< or go on
  bool step = false;
  bool localization = false;  ///< or mapping again
  bool reset = false;
  bool screenshot = false;
};

/// The words and switches over the 3-D view whose upper left corner is `corner`.
void draw_map_panel(const Gui& gui, const MapFacts& facts, ImVec2 corner, ImVec2 size, Layers& layers,
                    ViewControl& view);
/// What can be done with the run, at the view's lower edge.
[[nodiscard]] PanelWishes draw_play_panel(const Gui& gui, const RunFacts& run, ImVec2 corner, ImVec2 size);

}  // namespace cpslam::viewer
