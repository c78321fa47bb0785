#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/se3.h"
#include "sim/texture.h"

namespace cpslam::sim {

/// How a surface looks and answers the depth sensor.
struct Material {
  int texture = 0;                                   ///< index into SceneAssets::textures
  Eigen::Array3f tint_bgr = Eigen::Array3f::Ones();  ///< multiplies the texture
  bool returns_depth = true;                         ///< glass does not, to a structured-light sensor
};

struct SceneAssets {
  std::vector<Texture> textures;
  std::vector<Material> materials;
};

struct Vertex {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Eigen::Vector2f uv;  ///< texture coordinates, v down
  float light = 1.0F;  ///< multiplies the colour
};

/// Corners are counter-clockwise seen from the front; backs are not drawn.
struct Face {
  int a = 0, b = 0, c = 0;
  int material = 0;
};

/// Triangles in one frame (metres).
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
};

/// Materials of a box: seen from its front (-y), the sides, and the top.
struct BoxMaterials {
  int front, side, top;
  BoxMaterials(int all) : front(all), side(all), top(all) {}  // NOLINT: one material stands for all
  BoxMaterials(int front_m, int side_m, int top_m) : front(front_m), side(side_m), top(top_m) {}
};

/// One ring of a lathed body: an ellipse around (x, y) at height z.
struct Ring {
  float z, radius_x, radius_y;
  float x = 0.0F, y = 0.0F;
};

/// A parallelogram from corner (lower left, seen from its front) along right and up, split into n_right x
/// n_up patches for the vertex light. The texture covers it tiles_right x tiles_up times.
struct Patch {
  Eigen::Vector3d corner, right, up;
  int n_right = 1, n_up = 1;
  double tiles_right = 1.0, tiles_up = 1.0;
};

void add_patch(Mesh& mesh, const SE3& mesh_from_part, const Patch& patch, int material);

/// Axis-aligned in the part's frame, its lower face centred at the origin; size along x, y, z (m). Each face
/// shows its whole texture upright, or, with tile_m > 0, one texture per tile_m metres.
void add_box(Mesh& mesh, const SE3& mesh_from_part, const Eigen::Vector3d& size,
             const BoxMaterials& materials, double tile_m = 0.0);

/// A closed body of rings from bottom to top; u runs around from the back (-x), v from top to bottom.
void add_lathe(Mesh& mesh, const SE3& mesh_from_part, const std::vector<Ring>& rings, int n_segments,
               int material);

/// Upright cylinder standing on the part's origin.
void add_cylinder(Mesh& mesh, const SE3& mesh_from_part, double radius, double height, int n_segments,
                  int material);

/// A rotation about z by yaw (rad), then a translation.
[[nodiscard]] SE3 placed(const Eigen::Vector3d& position, double yaw = 0.0);

}  // namespace cpslam::sim
