#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/palette.h"
#include "sim/rasterizer.h"

namespace cpslam::sim {

/// A ceiling lamp and the room whose walls keep its light in.
struct Lamp {
  Eigen::Vector3f position;
  Eigen::AlignedBox3f room;
  int room_id = 0;
};

/// Brightness at a point with a normal: diffuse lamps, light from all around, darker near the floor.
/// World frame: metres, z up.
class Lighting {
 public:
  void add(const Lamp& lamp) { lamps_.push_back(lamp); }
  [[nodiscard]] float at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

 private:
  std::vector<Lamp> lamps_;
};

/// All that stands still.
struct Scene {
  SceneAssets assets;
  std::vector<SceneObject> objects;
  Lighting lighting;
  std::vector<Eigen::AlignedBox3f> rooms;
  std::vector<Eigen::AlignedBox3f> obstacles;  ///< furniture on the floor

  /// Computes the light of every static vertex, with the shade furniture casts on the floor around it.
  void bake_light();
};

}  // namespace cpslam::sim
