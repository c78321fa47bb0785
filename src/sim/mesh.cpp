#include "sim/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cpslam::sim {
namespace {

void add_quad_faces(Mesh& mesh, int first, int columns, int rows, int material) {
  for (int y = 0; y + 1 < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const int a = first + y * columns + x;
      const int b = a + 1;
      const int c = a + columns;
      const int d = c + 1;
      mesh.faces.push_back({a, b, d, material});
      mesh.faces.push_back({a, d, c, material});
    }
  }
}

// Outward normals of an elliptic tube with slanting walls.
Eigen::Vector3d ring_normal(const std::vector<Ring>& rings, std::size_t i, double cosine, double sine) {
  const Ring& below = rings[i == 0 ? 0 : i - 1];
  const Ring& above = rings[std::min(i + 1, rings.size() - 1)];
  const Ring& ring = rings[i];
  const Eigen::Vector3d around(-ring.radius_x * sine, ring.radius_y * cosine, 0.0);
  const Eigen::Vector3d along(above.x + above.radius_x * cosine - below.x - below.radius_x * cosine,
                              above.y + above.radius_y * sine - below.y - below.radius_y * sine,
                              above.z - below.z);
  const Eigen::Vector3d normal = around.cross(along);
  if (normal.norm() > 1e-9) return normal.normalized();
  return {0.0, 0.0, i == 0 ? -1.0 : 1.0};
}

}  // namespace

void add_patch(Mesh& mesh, const SE3& mesh_from_part, const Patch& patch, int material) {
  const Eigen::Vector3d normal = mesh_from_part.rotation * patch.right.cross(patch.up).normalized();
  const int first = static_cast<int>(mesh.vertices.size());
  for (int j = 0; j <= patch.n_up; ++j) {
    for (int i = 0; i <= patch.n_right; ++i) {
      const double u = static_cast<double>(i) / patch.n_right;
      const double v = static_cast<double>(j) / patch.n_up;
      const Eigen::Vector3d point = mesh_from_part * (patch.corner + u * patch.right + v * patch.up);
      mesh.vertices.push_back(
          {point.cast<float>(), normal.cast<float>(),
           Eigen::Vector2d(u * patch.tiles_right, (1.0 - v) * patch.tiles_up).cast<float>(), 1.0F});
    }
  }
  add_quad_faces(mesh, first, patch.n_right + 1, patch.n_up + 1, material);
}

void add_box(Mesh& mesh, const SE3& mesh_from_part, const Eigen::Vector3d& size,
             const BoxMaterials& materials, double tile_m) {
  const Eigen::Vector3d half(0.5 * size.x(), 0.5 * size.y(), 0.0);
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  const std::array<Patch, 6> sides{{{-half, x, z},                             // front
                                    {half, -x, z},                             // back
                                    {{half.x(), -half.y(), 0}, y, z},          // right
                                    {{-half.x(), half.y(), 0}, -y, z},         // left
                                    {{-half.x(), -half.y(), size.z()}, x, y},  // top
                                    {{-half.x(), half.y(), 0}, x, -y}}};       // bottom
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Patch patch = sides[i];
    if (tile_m > 0.0) {
      patch.tiles_right = patch.right.norm() / tile_m;
      patch.tiles_up = patch.up.norm() / tile_m;
    }
    const int material = i == 0 ? materials.front : i >= 4 ? materials.top : materials.side;
    add_patch(mesh, mesh_from_part, patch, material);
  }
}

void add_lathe(Mesh& mesh, const SE3& mesh_from_part, const std::vector<Ring>& rings, int n_segments,
               int material) {
  const int first = static_cast<int>(mesh.vertices.size());
  const double bottom = rings.front().z;
  const double height = std::max(1e-6, static_cast<double>(rings.back().z) - bottom);
  for (std::size_t j = 0; j < rings.size(); ++j) {
    const Ring& ring = rings[j];
    for (int i = 0; i <= n_segments; ++i) {
      const double u = static_cast<double>(i) / n_segments;
      // The seam (u = 0 and 1) must be one point to the bit, or a crack of sub-pixels opens there.
      const double angle = std::numbers::pi + (i == n_segments ? 0.0 : 2.0 * std::numbers::pi * u);
      const double cosine = std::cos(angle);
      const double sine = std::sin(angle);
      const Eigen::Vector3d point(ring.x + ring.radius_x * cosine, ring.y + ring.radius_y * sine, ring.z);
      const Eigen::Vector3d normal = mesh_from_part.rotation * ring_normal(rings, j, cosine, sine);
      mesh.vertices.push_back({(mesh_from_part * point).cast<float>(), normal.cast<float>(),
                               Eigen::Vector2d(u, 1.0 - (ring.z - bottom) / height).cast<float>(), 1.0F});
    }
  }
  add_quad_faces(mesh, first, n_segments + 1, static_cast<int>(rings.size()), material);
}

void add_cylinder(Mesh& mesh, const SE3& mesh_from_part, double radius, double height, int n_segments,
                  int material) {
  const auto r = static_cast<float>(radius);
  const auto h = static_cast<float>(height);
  add_lathe(mesh, mesh_from_part, {{0, r, r}, {h, r, r}}, n_segments, material);
  add_lathe(mesh, mesh_from_part, {{h, r, r}, {h, 0, 0}}, n_segments, material);
}

SE3 placed(const Eigen::Vector3d& position, double yaw) {
  return {Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix(), position};
}

}  // namespace cpslam::sim
