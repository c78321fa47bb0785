#pragma once

#include <memory>

#include "sim/body.h"
#include "sim/presets.h"

namespace cpslam::sim {

/// What a person does: the posture at any time. Immutable.
class PersonScript {
 public:
  virtual ~PersonScript() = default;
  [[nodiscard]] virtual Posture posture(double time_s, const BodyShape& shape) const = 0;
};

/// The part of person id in a preset with people.
[[nodiscard]] std::unique_ptr<PersonScript> make_person_script(const PresetInfo& preset, int id,
                                                               Random& random);

}  // namespace cpslam::sim
