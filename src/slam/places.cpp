#include "slam/places.h"

#include <memory>
#include <shared_mutex>

namespace cpslam {

void Places::remember(const Map& map, KeyFrameId keyframe) {
  std::shared_ptr<const FrameFeatures> features;
  {
    const std::shared_lock lock(map.mutex());
    if (const KeyFrame* found = map.keyframe(keyframe)) features = found->features;
  }
  if (features == nullptr) return;
  database.add(keyframe, std::make_shared<const ImageWords>(vocabulary.transform(features->descriptors)));
}

}  // namespace cpslam
