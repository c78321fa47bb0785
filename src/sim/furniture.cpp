#include "sim/furniture.h"

#include <cmath>
#include <numbers>

namespace cpslam::sim {

void Furnisher::add(Mesh mesh, bool obstacle) {
  SceneObject object;
  object.mesh_in_world = std::move(mesh);
  object.update_bounds();
  if (obstacle) {
    Eigen::AlignedBox3f box;
    for (const Vertex& vertex : object.mesh_in_world.vertices) box.extend(vertex.position);
    scene_.obstacles.push_back(box);
  }
  scene_.objects.push_back(std::move(object));
}

void Furnisher::desk(const SE3& place, double width_m, Random& random) {
  constexpr double kDepth_m = 0.8;
  constexpr double kHeight_m = 0.74;
  Mesh mesh;
  const int wood = choose(palette_.woods, random);
  add_box(mesh, place * placed({0, 0, kHeight_m - 0.03}), {width_m, kDepth_m, 0.03}, wood, 0.8);
  for (const double side : {-1.0, 1.0})
    add_box(mesh, place * placed({side * (0.5 * width_m - 0.04), 0.02, 0}),
            {0.04, kDepth_m - 0.1, kHeight_m - 0.03}, palette_.grey);
  add_box(mesh, place * placed({0, 0.3, 0.25}), {width_m - 0.1, 0.02, 0.4}, wood, 0.8);
  add_box(mesh, place * placed({0.5 * width_m - 0.27, 0.02, 0.06}), {0.4, 0.6, 0.56},
          {choose(palette_.drawers, random), palette_.grey, palette_.grey});
  desk_things(mesh, place * placed({0, 0, kHeight_m}), width_m, random);
  add(std::move(mesh), true);
}

void Furnisher::table(const SE3& place, const Eigen::Vector2d& size_m, Random& random) {
  Mesh mesh;
  const int wood = choose(palette_.woods, random);
  add_box(mesh, place * placed({0, 0, 0.71}), {size_m.x(), size_m.y(), 0.03}, wood, 0.8);
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      add_box(mesh, place * placed({x * (size_m.x() - 0.12), y * (size_m.y() - 0.12), 0}), {0.06, 0.06, 0.71},
              palette_.steel);
  table_things(mesh, place * placed({0, 0, 0.74}), size_m, random);
  add(std::move(mesh), true);
}

void Furnisher::office_chair(const SE3& place, Random& random) {
  Mesh mesh;
  const int fabric = choose(palette_.fabrics, random);
  constexpr double kFifth = 2.0 * std::numbers::pi / 5.0;
  for (int i = 0; i < 5; ++i) {
    const SE3 arm = place * placed({0, 0, 0.06}, kFifth * i);
    add_box(mesh, arm * placed({0.15, 0, 0}), {0.28, 0.04, 0.035}, palette_.dark);
    add_cylinder(mesh, arm * placed({0.28, 0, -0.06}), 0.03, 0.06, 8, palette_.dark);
  }
  add_cylinder(mesh, place * placed({0, 0, 0.08}), 0.03, 0.34, 10, palette_.steel);
  add_box(mesh, place * placed({0, 0, 0.41}), {0.46, 0.44, 0.07}, fabric, 0.3);
  // The back stands on the side away from the desk: somebody sitting looks along +y.
  const SE3 back(Eigen::AngleAxisd(0.12, Eigen::Vector3d::UnitX()).toRotationMatrix(), {0, -0.22, 0.56});
  add_box(mesh, place * back, {0.42, 0.06, 0.42}, fabric, 0.3);
  add_box(mesh, place * placed({0, -0.25, 0.42}), {0.06, 0.03, 0.25}, palette_.dark);
  for (const double side : {-1.0, 1.0})
    add_box(mesh, place * placed({side * 0.26, 0, 0.62}), {0.05, 0.26, 0.03}, palette_.dark);
  add(std::move(mesh), true);
}

void Furnisher::bookshelf(const SE3& place, double width_m, int n_boards, Random& random) {
  constexpr double kDepth_m = 0.3;
  constexpr double kPitch_m = 0.36;
  constexpr double kBoard_m = 0.02;
  Mesh mesh;
  const int wood = choose(palette_.woods, random);
  const double height = n_boards * kPitch_m + kBoard_m;
  add_box(mesh, place * placed({0, -0.01, 0}), {width_m, 0.02, height}, wood, 0.8);
  for (const double side : {-1.0, 1.0})
    add_box(mesh, place * placed({side * 0.5 * (width_m - kBoard_m), -0.5 * kDepth_m, 0}),
            {kBoard_m, kDepth_m, height}, wood, 0.8);
  for (int i = 0; i <= n_boards; ++i) {
    const SE3 board = place * placed({0, -0.5 * kDepth_m, i * kPitch_m});
    add_box(mesh, board, {width_m, kDepth_m, kBoard_m}, wood, 0.8);
    if (i < n_boards)
      book_row(mesh, board * placed({0, 0, kBoard_m}), width_m - 0.05, kPitch_m - 0.05, random);
  }
  if (random.uniform() < 0.6)
    add_box(mesh, place * placed({random.uniform(-0.2, 0.2), -0.16, height}), {0.38, 0.28, 0.26},
            choose(palette_.labels, random));
  add(std::move(mesh), true);
}

void Furnisher::book_row(Mesh& mesh, const SE3& at, double width_m, double height_m, Random& random) {
  double x = -0.5 * width_m;
  while (x < 0.5 * width_m - 0.06) {
    const double choice = random.uniform();
    if (choice < 0.05) {
      x += random.uniform(0.05, 0.15);
    } else if (choice < 0.09 && x < 0.5 * width_m - 0.3) {
      add_box(mesh, at * placed({x + 0.14, -0.02, 0}), {0.26, 0.22, 0.18}, choose(palette_.labels, random));
      x += 0.29;
    } else {
      const double width = random.uniform(0.018, 0.055);
      const double depth = random.uniform(0.14, 0.23);
      const double height = height_m * random.uniform(0.6, 0.95);
      const int spine = choose(palette_.spines, random);
      // Backs stand at slightly different depths, as books do.
      const double front = -0.13 + random.uniform(0.0, 0.04);
      add_box(mesh, at * placed({x + 0.5 * width, front + 0.5 * depth, 0}), {width, depth, height},
              {spine, spine, palette_.white});
      x += width + random.uniform(0.0005, 0.003);
    }
  }
}

void Furnisher::cabinet(const SE3& place, const Eigen::Vector3d& size_m, Random& random) {
  Mesh mesh;
  const int body = random.uniform() < 0.5 ? palette_.grey : choose(palette_.woods, random);
  add_box(mesh, place * placed({0, -0.5 * size_m.y(), 0}), size_m,
          {choose(palette_.drawers, random), body, body});
  const SE3 top = place * placed({0, -0.5 * size_m.y(), size_m.z()});
  if (random.uniform() < 0.5) foliage(mesh, top * placed({-0.1, 0, 0}), 0.25, random);
  book_pile(mesh, top * placed({0.5 * size_m.x() - 0.2, 0, 0}, random.uniform(-0.4, 0.4)), random);
  add(std::move(mesh), true);
}

void Furnisher::sofa(const SE3& place, Random& random) {
  Mesh mesh;
  const int fabric = choose(palette_.fabrics, random);
  add_box(mesh, place * placed({0, -0.45, 0.08}), {1.8, 0.8, 0.34}, fabric, 0.35);
  add_box(mesh, place * placed({0, -0.12, 0.4}), {1.8, 0.2, 0.42}, fabric, 0.35);
  for (const double side : {-1.0, 1.0})
    add_box(mesh, place * placed({side * 0.85, -0.45, 0.4}), {0.16, 0.8, 0.2}, fabric, 0.35);
  const SE3 cushion(Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                    {-0.45, -0.36, 0.42});
  add_box(mesh, place * cushion, {0.42, 0.12, 0.38}, choose(palette_.rugs, random));
  add(std::move(mesh), true);
}

void Furnisher::kitchen(const SE3& place, Random& random) {
  Mesh mesh;
  for (int i = -1; i <= 1; ++i) {
    const int front = choose(palette_.drawers, random);
    const BoxMaterials materials(front, palette_.white, palette_.white);
    add_box(mesh, place * placed({0.6 * i, -0.3, 0.08}), {0.59, 0.58, 0.78}, materials);
    add_box(mesh, place * placed({0.6 * i, -0.17, 1.45}), {0.59, 0.33, 0.6}, materials);
  }
  add_box(mesh, place * placed({0, -0.31, 0.86}), {1.82, 0.62, 0.04}, choose(palette_.woods, random), 0.6);
  add_box(mesh, place * placed({1.22, -0.32, 0}), {0.6, 0.62, 1.75}, palette_.steel);
  for (int i = 0; i < 4; ++i)
    mug(mesh, place * placed({-0.7 + 0.24 * i, random.uniform(-0.45, -0.2), 0.9}), random);
  add_box(mesh, place * placed({0.6, -0.25, 0.9}), {0.44, 0.34, 0.27},
          {choose(palette_.screens, random), palette_.dark, palette_.dark});
  add_box(mesh, place * placed({-0.15, -0.12, 0.9}), {0.2, 0.14, 0.3}, choose(palette_.labels, random));
  for (int i = 0; i < 3; ++i)
    add_patch(mesh, place, {{1.0 + 0.16 * i, -0.634, 1.1 + 0.12 * (i % 2)}, {0.12, 0, 0}, {0, 0, 0.16}},
              choose(palette_.papers, random));
  add(std::move(mesh), true);
}

void Furnisher::plant(const SE3& place, Random& random) {
  Mesh mesh;
  foliage(mesh, place, 0.7, random);
  add(std::move(mesh), true);
}

void Furnisher::waste_bin(const SE3& place) {
  Mesh mesh;
  add_lathe(mesh, place, {{0, 0.11F, 0.11F}, {0.32F, 0.15F, 0.15F}, {0.32F, 0.14F, 0.14F}, {0.25F, 0, 0}}, 16,
            palette_.dark);
  add(std::move(mesh), true);
}

void Furnisher::carton(const SE3& place, Random& random) {
  Mesh mesh;
  const int side = choose(palette_.labels, random);
  const double height = random.uniform(0.25, 0.4);
  add_box(mesh, place, {0.42, 0.36, height}, {side, side, choose(palette_.woods, random)});
  add(std::move(mesh), true);
}

void Furnisher::rug(const SE3& place, Random& random) {
  Mesh mesh;
  add_patch(mesh, place, {{-1.0, -0.75, 0.006}, {2.0, 0, 0}, {0, 1.5, 0}, 8, 6},
            choose(palette_.rugs, random));
  add(std::move(mesh), false);
}

}  // namespace cpslam::sim
