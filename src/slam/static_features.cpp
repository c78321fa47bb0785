#include "slam/static_features.h"

#include "slam/frame_input.h"

namespace cpslam {

StaticFeatures::StaticFeatures(const Settings& settings, People& people, StageTimer& timer)
    : people_(people), timer_(timer), builder_(settings.camera, settings.orb) {}

std::shared_ptr<const FrameFeatures> StaticFeatures::extract(const RgbdFrame& frame,
                                                             const SE3& depth_from_colour) {
  {
    const auto scope = timer_.time("track: features");
    candidates_ = &builder_.extract(to_grey(frame.colour), frame.depth, depth_from_colour, people_.prior());
  }
  kept_ = people_.filter(*candidates_);
  if (const int missing = people_.missing_keypoints(kept_); missing > 0) {
    builder_.extend(*candidates_, people_.excluded(), missing);
    kept_ = people_.filter(*candidates_);
  }
  return builder_.finish(*candidates_, kept_);
}

void StaticFeatures::show(const std::vector<bool>& tracked, FrameView& view) const {
  std::size_t n_kept = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const OrbKeypoint& k = candidates_->orb.keypoints[i];
    FrameView::Kind kind = FrameView::Kind::kRemoved;
    if (kept_[i] != 0) {
      const bool holds_point = n_kept < tracked.size() && tracked[n_kept];
      kind = holds_point ? FrameView::Kind::kTracked : FrameView::Kind::kKept;
      ++n_kept;
    }
    view.keypoints.push_back({k.x, k.y, kind});
  }
}

}  // namespace cpslam
