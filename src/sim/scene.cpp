#include "sim/scene.h"

#include <algorithm>
#include <cmath>

namespace cpslam::sim {
namespace {

// 1 in the open, down to 0.45 under furniture, with soft edges.
float floor_shade(const Eigen::Vector3f& point, const std::vector<Eigen::AlignedBox3f>& obstacles) {
  constexpr float kReach_m = 0.3F;
  float shade = 1.0F;
  for (const Eigen::AlignedBox3f& box : obstacles) {
    const Eigen::Vector2f outside = (box.min().head<2>() - point.head<2>())
                                        .cwiseMax(point.head<2>() - box.max().head<2>())
                                        .cwiseMax(0.0F);
    const float openness = std::min(1.0F, outside.norm() / kReach_m);
    shade *= 0.55F + 0.45F * openness * (2.0F - openness);
  }
  return std::max(shade, 0.45F);
}

}  // namespace

float Lighting::at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const {
  float direct = 0.0F;
  int room_id = -1;  // a point in a doorway is lit from the first of its rooms only
  for (const Lamp& lamp : lamps_) {
    if ((room_id >= 0 && lamp.room_id != room_id) || !lamp.room.contains(point)) continue;
    room_id = lamp.room_id;
    const Eigen::Vector3f to_lamp = lamp.position - point;
    const float distance2 = to_lamp.squaredNorm();
    // Lamps are large panels: light wraps a little around edges.
    const float cosine = (normal.dot(to_lamp) / std::sqrt(distance2 + 1e-6F) + 0.25F) / 1.25F;
    direct += std::max(0.0F, cosine) * 1.6F / (1.5F + distance2);
  }
  const float ambient = 0.50F + 0.06F * normal.z() + 0.03F * std::abs(normal.x());
  const float height = std::clamp(point.z() / 0.4F, 0.0F, 1.0F);
  return (ambient + 0.8F * direct / (0.55F + direct)) * (0.88F + 0.12F * height);
}

void Scene::bake_light() {
  for (SceneObject& object : objects) {
    for (Vertex& vertex : object.mesh_in_world.vertices) {
      vertex.light = lighting.at(vertex.position, vertex.normal);
      const bool on_floor = vertex.position.z() < 0.02F && vertex.normal.z() > 0.9F;
      if (on_floor) vertex.light *= floor_shade(vertex.position, obstacles);
    }
  }
}

}  // namespace cpslam::sim
