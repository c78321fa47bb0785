#include <cmath>
#include <numbers>

#include "sim/furniture.h"

// What stands on desks and hangs on walls.
namespace cpslam::sim {

void Furnisher::monitor(Mesh& mesh, const SE3& at, Random& random) {
  const double width = random.uniform(0.48, 0.58);
  const double height = 0.62 * width;
  add_box(mesh, at, {0.24, 0.18, 0.015}, palette_.dark);
  add_box(mesh, at * placed({0, 0.03, 0.01}), {0.05, 0.03, 0.2}, palette_.dark);
  add_box(mesh, at * placed({0, 0, 0.12}), {width, 0.035, height}, palette_.dark);
  constexpr double kBezel_m = 0.018;
  const Eigen::Vector3d right(width - 2 * kBezel_m, 0, 0), up(0, 0, height - 2 * kBezel_m);
  add_patch(mesh, at, {{-0.5 * width + kBezel_m, -0.0195, 0.12 + kBezel_m}, right, up},
            choose(palette_.screens, random));
  // A sticker with the serial number on the back.
  add_patch(mesh, at, {{0.09, 0.0195, 0.2}, {-0.18, 0, 0}, {0, 0, 0.1}}, choose(palette_.labels, random));
}

void Furnisher::paper(Mesh& mesh, const SE3& at, Random& random) {
  add_patch(mesh, at, {{-0.105, -0.148, 0.002}, {0.21, 0, 0}, {0, 0.297, 0}},
            choose(palette_.papers, random));
}

void Furnisher::book_pile(Mesh& mesh, const SE3& at, Random& random) {
  double z = 0.0;
  const std::size_t n = 1 + random.index(4);
  for (std::size_t i = 0; i < n; ++i) {
    const double thickness = random.uniform(0.015, 0.045);
    const double yaw = random.uniform(-0.25, 0.25);
    const int cover = choose(palette_.covers, random);
    const int spine = choose(palette_.labels, random);
    add_box(mesh, at * placed({0, 0, z}, yaw), {0.17, 0.24, thickness}, {spine, palette_.white, cover});
    z += thickness;
  }
}

void Furnisher::mug(Mesh& mesh, const SE3& at, Random& random) {
  const int material = choose(palette_.mugs, random);
  add_cylinder(mesh, at, 0.04, 0.095, 14, material);
  add_box(mesh, at * placed({0.052, 0, 0.02}), {0.025, 0.012, 0.055}, material);
}

void Furnisher::desk_lamp(Mesh& mesh, const SE3& at) {
  add_cylinder(mesh, at, 0.08, 0.02, 16, palette_.dark);
  add_cylinder(mesh, at, 0.012, 0.4, 8, palette_.steel);
  const SE3 arm(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix(), {0, 0, 0.4});
  add_cylinder(mesh, at * arm, 0.012, 0.26, 8, palette_.steel);
  add_lathe(mesh, at * placed({0, -0.22, 0.46}), {{0, 0.07F, 0.07F}, {0.1F, 0.03F, 0.03F}, {0.1F, 0, 0}}, 14,
            palette_.dark);
}

void Furnisher::foliage(Mesh& mesh, const SE3& at, double size_m, Random& random) {
  const auto r = static_cast<float>(0.35 * size_m);
  const std::vector<Ring> pot{
      {0, 0.7F * r, 0.7F * r}, {1.4F * r, r, r}, {1.4F * r, 0.9F * r, 0.9F * r}, {1.3F * r, 0, 0}};
  add_lathe(mesh, at, pot, 14, choose(palette_.mugs, random));
  for (int i = 0; i < 22; ++i) {
    const double yaw = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double lean = random.uniform(0.2, 1.2);
    const auto l = static_cast<float>(size_m * random.uniform(0.7, 1.3));
    const SE3 leaf =
        at * placed({0, 0, 1.3 * static_cast<double>(r)}, yaw) *
        SE3(Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitY()).toRotationMatrix(), Eigen::Vector3d::Zero());
    const std::vector<Ring> blade{
        {0, 0.004F, 0.004F}, {0.5F * l, 0.008F, 0.035F}, {0.8F * l, 0.006F, 0.03F}, {l, 0.001F, 0.002F}};
    add_lathe(mesh, leaf, blade, 6, palette_.green);
  }
}

void Furnisher::desk_things(Mesh& mesh, const SE3& top, double width_m, Random& random) {
  const double right_end = 0.5 * width_m;
  const auto put = [&](double x, double y, double z, double yaw_range) {
    return top * placed({x, y, z}, random.uniform(-yaw_range, yaw_range));
  };
  if (random.uniform() < 0.5) {
    monitor(mesh, top * placed({-0.32, 0.17, 0}, 0.16), random);
    monitor(mesh, top * placed({0.3, 0.18, 0}, -0.16), random);
  } else {
    monitor(mesh, put(random.uniform(-0.15, 0.1), 0.15, 0, 0.15), random);
    book_pile(mesh, put(right_end - 0.25, 0.2, 0, 0.5), random);
    desk_lamp(mesh, put(0.2 - right_end, 0.24, 0, 0.0));
  }
  const int keyboard = choose(palette_.keyboards, random);
  add_box(mesh, put(random.uniform(-0.12, 0.05), -0.2, 0, 0.08), {0.45, 0.155, 0.022},
          {palette_.dark, palette_.dark, keyboard});
  const std::vector<Ring> mouse{
      {0, 0.03F, 0.055F}, {0.02F, 0.028F, 0.05F}, {0.034F, 0.012F, 0.02F}, {0.036F, 0, 0}};
  add_lathe(mesh, put(0.36, -0.2, 0, 0.3), mouse, 12, palette_.grey);
  mug(mesh, put(random.uniform(0.15, 0.3) - right_end, random.uniform(-0.25, 0.0), 0, 3.0), random);
  for (int i = 0; i < 3; ++i) {
    const double x = (i % 2 == 0 ? -1.0 : 1.0) * random.uniform(0.42, right_end - 0.17);
    paper(mesh, put(x, random.uniform(-0.22, 0.0), 0.001 * i, 0.5), random);
  }
  if (random.uniform() < 0.6)
    book_pile(mesh, put(right_end - 0.16, random.uniform(-0.2, 0.05), 0.004, 0.6), random);
  add_cylinder(mesh, top * placed({0.06, 0.02, 0}), 0.035, 0.1, 12, choose(palette_.mugs, random));
  for (int i = 0; i < 4; ++i)
    add_box(mesh, top * placed({0.045 + 0.01 * i, 0.01 + 0.008 * (i % 2), 0.04}),
            {0.007, 0.007, 0.1 + 0.01 * i}, i % 2 == 0 ? palette_.green : palette_.dark);
}

void Furnisher::table_things(Mesh& mesh, const SE3& top, const Eigen::Vector2d& size_m, Random& random) {
  for (int i = 0; i < 6; ++i) {
    const double x = random.uniform(-0.4, 0.4) * size_m.x();
    const double y = random.uniform(-0.36, 0.36) * size_m.y();
    const SE3 at = top * placed({x, y, 0.001 * i}, random.uniform(-3.0, 3.0));
    if (i % 3 == 0) paper(mesh, at, random);
    if (i % 3 == 1) mug(mesh, at, random);
    if (i % 3 == 2) book_pile(mesh, at, random);
  }
}

void Furnisher::picture(const SE3& place, double height_m, const Eigen::Vector2d& size_m, int material,
                        bool framed) {
  Mesh mesh;
  const double w = size_m.x(), h = size_m.y();
  constexpr double kFrame_m = 0.025;
  if (framed)
    add_box(mesh, place * placed({0, -0.008, height_m - 0.5 * h - kFrame_m}),
            {w + 2 * kFrame_m, 0.016, h + 2 * kFrame_m}, palette_.dark);
  const double out = framed ? 0.02 : 0.005;
  add_patch(mesh, place, {{-0.5 * w, -out, height_m - 0.5 * h}, {w, 0, 0}, {0, 0, h}, 3, 3}, material);
  add(std::move(mesh), false);
}

void Furnisher::poster(const SE3& place, double height_m, double width_m, Random& random) {
  const int material = choose(palette_.posters, random);
  picture(place, height_m, {width_m, std::numbers::sqrt2 * width_m}, material, random.uniform() < 0.3);
}

void Furnisher::whiteboard(const SE3& place, Random& random) {
  picture(place, 1.45, {1.5, 0.98}, choose(palette_.whiteboards, random), true);
}

void Furnisher::notice_board(const SE3& place, Random& random) {
  picture(place, 1.5, {1.2, 0.84}, choose(palette_.notice_boards, random), false);
}

void Furnisher::window(const SE3& place, double width_m, Random& random) {
  constexpr double kSill_m = 0.9, kHeight_m = 1.3;
  Mesh mesh;
  add_patch(mesh, place, {{-0.5 * width_m, -0.004, kSill_m}, {width_m, 0, 0}, {0, 0, kHeight_m}, 4, 4},
            choose(palette_.window_views, random));
  for (int i = 0; i < 3; ++i)
    add_box(mesh, place * placed({0.5 * width_m * (i - 1), -0.025, kSill_m}), {0.06, 0.05, kHeight_m},
            palette_.white);
  for (const double z : {kSill_m - 0.05, kSill_m + kHeight_m})
    add_box(mesh, place * placed({0, -0.03, z}), {width_m + 0.1, 0.06, 0.05}, palette_.white);
  add_box(mesh, place * placed({0, -0.11, kSill_m - 0.06}), {width_m + 0.2, 0.22, 0.03}, palette_.white);
  add_box(mesh, place * placed({0, -0.08, 0.15}), {0.8 * width_m, 0.09, 0.6},
          {palette_.radiator, palette_.white, palette_.white});
  mug(mesh, place * placed({0.3 * width_m, -0.12, kSill_m - 0.03}), random);
  foliage(mesh, place * placed({-0.28 * width_m, -0.12, kSill_m - 0.03}), 0.2, random);
  add(std::move(mesh), true);
}

void Furnisher::closed_door(const SE3& place, Random& random) {
  Mesh mesh;
  add_patch(mesh, place, {{-0.45, -0.01, 0}, {0.9, 0, 0}, {0, 0, 2.05}, 2, 5},
            choose(palette_.doors, random));
  for (const double x : {-0.49, 0.49})
    add_box(mesh, place * placed({x, -0.02, 0}), {0.08, 0.04, 2.1}, palette_.white);
  add_box(mesh, place * placed({0, -0.02, 2.05}), {0.9, 0.04, 0.08}, palette_.white);
  add(std::move(mesh), false);
}

void Furnisher::wall_clock(const SE3& place, double height_m) {
  picture(place, height_m, {0.3, 0.3}, palette_.clock, true);
}

void Furnisher::light_switch(const SE3& place) {
  Mesh mesh;
  add_box(mesh, place * placed({0, -0.005, 1.05}), {0.08, 0.01, 0.08}, palette_.white);
  add_box(mesh, place * placed({0, -0.011, 1.065}), {0.05, 0.006, 0.05}, palette_.grey);
  add_box(mesh, place * placed({0.2, -0.005, 0.3}), {0.15, 0.01, 0.08}, palette_.white);
  add(std::move(mesh), false);
}

}  // namespace cpslam::sim
