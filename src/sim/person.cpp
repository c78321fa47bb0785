#include "sim/person.h"

#include "sim/paint.h"

namespace cpslam::sim {
namespace {

Clothes dress(SceneAssets& assets, Random& random) {
  const double tone = random.uniform(0.45, 1.0);
  const cv::Scalar skin(150 * tone, 172 * tone, 215 * tone);
  Clothes clothes;
  clothes.shirt = add_material(assets, paint_shirt(random), Texture::Wrap::kRepeat);
  clothes.trousers = add_material(assets, paint_trousers(random), Texture::Wrap::kRepeat);
  clothes.shoes =
      add_material(assets, paint_skin(random_colour(random, 20, 70), random), Texture::Wrap::kRepeat);
  clothes.skin = add_material(assets, paint_skin(skin, random), Texture::Wrap::kRepeat);
  clothes.head = add_material(assets, paint_head(skin, random), Texture::Wrap::kClamp);
  clothes.long_sleeves = random.uniform() < 0.6;
  return clothes;
}

}  // namespace

Person::Person(int id, std::unique_ptr<PersonScript> script, SceneAssets& assets, Random& random)
    : id_(id),
      shape_(BodyShape::random(random)),
      parts_(make_body(shape_, dress(assets, random))),
      script_(std::move(script)) {}

Joints Person::joints(double time_s) const {
  return pose_skeleton(shape_, script_->posture(time_s, shape_)).joints;
}

void Person::pose_at(double time_s, const Lighting& lighting, SceneObject& object) const {
  const Skeleton skeleton = pose_skeleton(shape_, script_->posture(time_s, shape_));
  Mesh& body = object.mesh_in_world;
  const bool first = body.faces.empty();
  body.vertices.clear();
  for (const BodyPart& part : parts_) {
    const SE3 world_from_part = part_pose(part, skeleton);
    const Eigen::Matrix3f rotation = world_from_part.rotation.cast<float>();
    const Eigen::Vector3f translation = world_from_part.translation.cast<float>();
    const int offset = static_cast<int>(body.vertices.size());
    for (const Vertex& vertex : part.mesh.vertices) {
      const Eigen::Vector3f point = rotation * vertex.position + translation;
      const Eigen::Vector3f normal = rotation * vertex.normal;
      body.vertices.push_back({point, normal, vertex.uv, lighting.at(point, normal)});
    }
    if (!first) continue;
    for (const Face& face : part.mesh.faces)
      body.faces.push_back({face.a + offset, face.b + offset, face.c + offset, face.material});
  }
  object.label = static_cast<std::uint8_t>(id_ + 1);
  object.update_bounds();
}

}  // namespace cpslam::sim
