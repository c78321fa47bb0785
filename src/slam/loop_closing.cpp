#include "slam/loop_closing.h"

#include <algorithm>
#include <numbers>
#include <shared_mutex>
#include <string>

#include "slam/loop_correction.h"

namespace cpslam {
namespace {

// After a loop the next keyframes see the same two sides, which are one by now.
constexpr std::uint64_t kRestKeyframes = 10;

/// When a keyframe came, and which others tracking knows to show the same.
struct View {
  std::uint64_t sequence = 0;
  std::vector<KeyFrameId> connected;
};

std::optional<View> view_of(const Map& map, KeyFrameId id) {
  const std::shared_lock lock(map.mutex());
  const KeyFrame* keyframe = map.keyframe(id);
  if (keyframe == nullptr) return std::nullopt;
  return View{keyframe->sequence, map.best_covisible(id, keyframe->covisible.size())};
}

}  // namespace

std::optional<VerifiedLoop> LoopClosing::find(KeyFrameId keyframe) {
  const std::shared_ptr<const ImageWords> words = places_.database.words(keyframe);
  const std::optional<View> view = view_of(map_, keyframe);
  if (!words || !view) return std::nullopt;
  if (last_loop_ && view->sequence < *last_loop_ + kRestKeyframes) return std::nullopt;
  std::vector<KeyFrameId> consistent;
  {
    const auto scope = timer_.time("loop: detection");
    consistent = consistency_.update(map_, alike_places(keyframe, view->connected, *words));
  }
  for (const KeyFrameId candidate : consistent) {
    const auto scope = timer_.time("loop: verification");
    const std::shared_ptr<const ImageWords> its_words = places_.database.words(candidate);
    if (!its_words) continue;
    const IndexPair indices{words->features, its_words->features};
    if (auto loop = verify_loop(rig_, map_, keyframe, candidate, indices, random_)) return loop;
  }
  return std::nullopt;
}

std::vector<KeyFrameId> LoopClosing::alike_places(KeyFrameId keyframe,
                                                  const std::vector<KeyFrameId>& connected,
                                                  const ImageWords& words) const {
  PlaceQuery query;
  query.excluded = connected;
  query.excluded.push_back(keyframe);
  // What looks less alike than the keyframes around does tells nothing.
  query.min_score = 1.0;
  for (const KeyFrameId neighbour : connected) {
    if (const auto its_words = places_.database.words(neighbour)) {
      query.min_score = std::min(query.min_score, score(words.bow, its_words->bow));
    }
  }
  std::vector<KeyFrameId> alike;
  for (const PlaceCandidate& candidate : places_.database.candidates(map_, words.bow, query)) {
    alike.push_back(candidate.keyframe);
  }
  return alike;
}

bool LoopClosing::close(const VerifiedLoop& loop, const std::atomic<bool>& abort) {
  LoopEvent event;
  {
    const std::shared_lock lock(map_.mutex());
    const KeyFrame* current = map_.keyframe(loop.edge.current);
    const KeyFrame* matched = map_.keyframe(loop.edge.matched);
    if (current == nullptr || matched == nullptr) return false;
    last_loop_ = current->sequence;
    event.time_s = current->time_s;
    event.matched_time_s = matched->time_s;
  }
  consistency_.reset();
  const std::optional<ClosedLoop> closed = close_loop(rig_, map_, loop, timer_, abort);
  if (!closed) return false;
  event.inliers = loop.inliers;
  event.error_m = closed->distance_m;
  event.error_deg = closed->angle_rad * 180.0 / std::numbers::pi;
  event.joined_map = closed->joined_session;
  tell(event);
  const std::lock_guard lock(mutex_);
  statistics_.events.push_back(event);
  return true;
}

void LoopClosing::tell(const LoopEvent& event) const {
  const std::string place = "the place of " + std::to_string(event.matched_time_s) + " s again; ";
  if (event.joined_map != 0) {
    log_.info("loop closed: " + place + "map " + std::to_string(event.joined_map) +
              " is part of the older one now");
  } else {
    log_.info("loop closed: " + place + "the map was " + std::to_string(event.error_m) + " m off");
  }
}

LoopStatistics LoopClosing::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

}  // namespace cpslam
