#pragma once

#include <utility>

#include "sim/scene.h"

namespace cpslam::sim {

/// Puts furniture into a scene. A place is a frame on the floor: x to the right and y away from somebody who
/// looks at the thing's front, z up. Things that lean on a wall have their back at y = 0.
/// Choices (which books, which screen) come from the generator passed in, so that the same seed gives the
/// same desk twice.
class Furnisher {
 public:
  Furnisher(Scene& scene, Palette palette) : scene_(scene), palette_(std::move(palette)) {}

  // Free-standing; their middle at the origin.
  void desk(const SE3& place, double width_m, Random& random);
  void table(const SE3& place, const Eigen::Vector2d& size_m, Random& random);
  void office_chair(const SE3& place, Random& random);
  void plant(const SE3& place, Random& random);
  void waste_bin(const SE3& place);
  void carton(const SE3& place, Random& random);
  void rug(const SE3& place, Random& random);

  // Against a wall.
  void bookshelf(const SE3& place, double width_m, int n_boards, Random& random);
  void cabinet(const SE3& place, const Eigen::Vector3d& size_m, Random& random);
  void sofa(const SE3& place, Random& random);
  void kitchen(const SE3& place, Random& random);

  // On a wall; place at the floor below.
  void poster(const SE3& place, double height_m, double width_m, Random& random);
  void picture(const SE3& place, double height_m, const Eigen::Vector2d& size_m, int material, bool framed);
  void whiteboard(const SE3& place, Random& random);
  void notice_board(const SE3& place, Random& random);
  void window(const SE3& place, double width_m, Random& random);
  void closed_door(const SE3& place, Random& random);
  void wall_clock(const SE3& place, double height_m);
  void light_switch(const SE3& place);

  [[nodiscard]] const Palette& palette() const { return palette_; }
  /// Makes an object of the mesh; with an obstacle, nobody may walk through it.
  void add(Mesh mesh, bool obstacle);

 private:
  static int choose(const std::vector<int>& materials, Random& random) {
    return materials[random.index(materials.size())];
  }
  void desk_things(Mesh& mesh, const SE3& top, double width_m, Random& random);
  void table_things(Mesh& mesh, const SE3& top, const Eigen::Vector2d& size_m, Random& random);
  void monitor(Mesh& mesh, const SE3& at, Random& random);
  void book_row(Mesh& mesh, const SE3& at, double width_m, double height_m, Random& random);
  void paper(Mesh& mesh, const SE3& at, Random& random);
  void book_pile(Mesh& mesh, const SE3& at, Random& random);
  void mug(Mesh& mesh, const SE3& at, Random& random);
  void desk_lamp(Mesh& mesh, const SE3& at);
  void foliage(Mesh& mesh, const SE3& at, double size_m, Random& random);

  Scene& scene_;
  Palette palette_;
};

}  // namespace cpslam::sim
