#pragma once

#include <vector>

#include "sim/body.h"
#include "sim/person_scripts.h"
#include "sim/scene.h"

namespace cpslam::sim {

/// A dressed body that follows a script.
class Person {
 public:
  /// Paints skin and clothes into the assets.
  Person(int id, std::unique_ptr<PersonScript> script, SceneAssets& assets, Random& random);

  /// The body's surface at a time, lit.
  void pose_at(double time_s, const Lighting& lighting, SceneObject& object) const;
  [[nodiscard]] Joints joints(double time_s) const;

 private:
  int id_;
  BodyShape shape_;
  std::vector<BodyPart> parts_;
  std::unique_ptr<PersonScript> script_;
};

}  // namespace cpslam::sim
