#include "slam/local_mapping.h"

#include <mutex>

#include "slam/keyframe_culling.h"
#include "slam/local_bundle.h"
#include "slam/point_creation.h"
#include "slam/point_fusion.h"

namespace cpslam {

void LocalMapping::process(KeyFrameId keyframe, const std::atomic<bool>& abort) {
  if (places_ != nullptr) {
    const auto scope = timer_.time("map: words");
    places_->remember(map_, keyframe);
  }
  {
    const auto scope = timer_.time("map: recent points");
    {
      const std::unique_lock lock(map_.mutex());
      map_.refresh_points_of(keyframe);
    }
    recent_points_.cull(map_, keyframe);
  }
  {
    const auto scope = timer_.time("map: new points");
    recent_points_.add(create_points(rig_, map_, keyframe));
  }
  {
    const auto scope = timer_.time("map: fusion");
    fuse_points(rig_, map_, keyframe);
  }
  if (abort) return;
  {
    const auto scope = timer_.time("map: local bundle adjustment");
    adjust_local_bundle(rig_, map_, keyframe, abort);
    ++bundle_adjustments_;
  }
  const auto scope = timer_.time("map: keyframe culling");
  const std::vector<KeyFrameId> culled = cull_keyframes(rig_, map_, keyframe);
  if (places_ == nullptr) return;
  for (const KeyFrameId id : culled) places_->database.erase(id);
}

}  // namespace cpslam
