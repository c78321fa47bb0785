#include "sim/palette.h"

#include <functional>

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

using Painter = std::function<cv::Mat()>;

std::vector<int> paint_several(SceneAssets& assets, int n, Texture::Wrap wrap, const Painter& painter) {
  std::vector<int> materials;
  materials.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) materials.push_back(add_material(assets, painter(), wrap));
  return materials;
}

int add_plain(SceneAssets& assets, const cv::Scalar& bgr) {
  return add_material(assets, cv::Mat(2, 2, CV_8UC3, bgr), Texture::Wrap::kRepeat);
}

void paint_large_surfaces(SceneAssets& assets, Palette& palette, Random& random) {
  constexpr auto kRepeat = Texture::Wrap::kRepeat;
  for (const cv::Scalar& colour : {cv::Scalar(208, 218, 222), cv::Scalar(214, 216, 212),
                                   cv::Scalar(190, 208, 216), cv::Scalar(206, 212, 196)})
    palette.walls.push_back(add_material(assets, paint_wall(colour, random), kRepeat));
  palette.floors = {add_material(assets, paint_carpet({104, 98, 92}, random), kRepeat),
                    add_material(assets, paint_floor_tiles({176, 184, 188}, random), kRepeat),
                    add_material(assets, paint_floor_planks({96, 134, 170}, random), kRepeat),
                    add_material(assets, paint_carpet({112, 96, 80}, random), kRepeat)};
  palette.ceiling = add_material(assets, paint_ceiling(random), kRepeat);
  for (const cv::Scalar& colour : {cv::Scalar(150, 184, 206), cv::Scalar(112, 150, 180),
                                   cv::Scalar(196, 206, 212), cv::Scalar(60, 82, 108)})
    palette.woods.push_back(add_material(assets, paint_wood(colour, random), kRepeat));
  for (const cv::Scalar& colour : {cv::Scalar(60, 56, 54), cv::Scalar(130, 70, 50), cv::Scalar(50, 50, 120),
                                   cv::Scalar(70, 100, 80), cv::Scalar(120, 130, 140)})
    palette.fabrics.push_back(add_material(assets, paint_fabric(colour, random), kRepeat));
}

}  // namespace

int add_material(SceneAssets& assets, const cv::Mat& bgr, Texture::Wrap wrap) {
  assets.textures.emplace_back(bgr, wrap);
  Material material;
  material.texture = static_cast<int>(assets.textures.size()) - 1;
  assets.materials.push_back(material);
  return static_cast<int>(assets.materials.size()) - 1;
}

Palette paint_palette(SceneAssets& assets, Random& random) {
  Palette palette;
  paint_large_surfaces(assets, palette, random);
  const auto several = [&](int n, cv::Mat (*paint)(Random&)) {
    return paint_several(assets, n, Texture::Wrap::kClamp, [&] { return paint(random); });
  };
  palette.rugs = several(4, paint_rug);
  palette.posters = several(32, paint_poster);
  palette.papers = several(8, paint_paper);
  palette.spines = several(24, paint_book_spine);
  palette.covers = several(8, paint_book_cover);
  palette.screens = several(8, paint_screen);
  palette.whiteboards = several(3, paint_whiteboard);
  palette.notice_boards = several(4, paint_notice_board);
  palette.labels = several(6, paint_label);
  palette.doors = several(3, paint_door);
  palette.window_views = several(4, paint_window_view);
  for (const int view : palette.window_views)
    assets.materials[static_cast<std::size_t>(view)].returns_depth = false;
  palette.keyboards = several(3, paint_keyboard);
  palette.mugs = paint_several(assets, 4, Texture::Wrap::kRepeat, [&] { return paint_mug(random); });
  palette.drawers = paint_several(assets, 3, Texture::Wrap::kClamp, [&] {
    const bool wooden = random.uniform() < 0.5;
    const int n_drawers = 2 + static_cast<int>(random.index(3));
    return paint_drawers(wooden ? cv::Scalar(140, 176, 200) : cv::Scalar(186, 188, 190), n_drawers, random);
  });
  palette.radiator = add_material(assets, paint_radiator(), Texture::Wrap::kRepeat);
  palette.clock = add_material(assets, paint_clock(), Texture::Wrap::kClamp);
  palette.white = add_plain(assets, {232, 234, 235});
  palette.grey = add_plain(assets, {150, 152, 154});
  palette.dark = add_plain(assets, {36, 35, 34});
  palette.steel = add_plain(assets, {172, 174, 174});
  palette.green = add_material(assets, paint_fabric({60, 120, 64}, random), Texture::Wrap::kRepeat);
  palette.lamp = add_plain(assets, {250, 252, 252});
  return palette;
}

}  // namespace cpslam::sim
