#pragma once

#include <vector>

#include "sim/mesh.h"
#include "util/random.h"

namespace cpslam::sim {

/// The materials a house is furnished from; painted once per simulation.
struct Palette {
  std::vector<int> walls, floors, woods, fabrics, rugs;
  std::vector<int> posters, papers, spines, covers, screens, whiteboards, notice_boards, labels;
  std::vector<int> doors, window_views, keyboards, drawers, mugs;
  int ceiling = 0, radiator = 0, clock = 0;
  int white = 0, grey = 0, dark = 0, steel = 0, green = 0, lamp = 0;
};

/// Adds the pictures to the assets. The same random state gives the same palette.
[[nodiscard]] Palette paint_palette(SceneAssets& assets, Random& random);

/// Adds one picture as a material and returns its index.
int add_material(SceneAssets& assets, const cv::Mat& bgr, Texture::Wrap wrap);

}  // namespace cpslam::sim
