#include "detect/people.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cpslam/error.h"
#include "detect/depth_grid.h"
#include "detect/keypoint_filter.h"
#include "detect/person_mask.h"
#include "detect/person_shapes.h"

namespace cpslam {
namespace {

constexpr int kEnoughKeypoints = 500;  // static ones, in a frame with people

DetectorThreadOptions thread_options(const Settings& settings) {
  DetectorThreadOptions options;
  const BoxesPolicy usual = settings.realtime ? BoxesPolicy::kLatest : BoxesPolicy::kWait;
  options.policy = settings.detector.policy.value_or(usual);
  options.sequential = settings.sequential;
  options.pretend_rate_hz = settings.detector.pretend_rate_hz;
  options.pretend_delay_s = settings.detector.pretend_delay_s;
  options.timeout_s = settings.detector.timeout_s;
  return options;
}

std::vector<DepthKeypoint> depth_keypoints(const KeypointCandidates& candidates) {
  std::vector<DepthKeypoint> keypoints;
  keypoints.reserve(candidates.orb.keypoints.size());
  for (std::size_t i = 0; i < candidates.orb.keypoints.size(); ++i) {
    const OrbKeypoint& k = candidates.orb.keypoints[i];
    keypoints.push_back({k.x, k.y, candidates.depth[i].depth_m});
  }
  return keypoints;
}

}  // namespace

People::People(const Settings& settings, std::unique_ptr<PersonDetector> detector, StageTimer& timer, Log log)
    : settings_(settings),
      metres_per_unit_(1.0 / settings.camera.depth_map_factor),
      timer_(timer),
      log_(std::move(log)),
      tracks_(PinholeCamera(settings.camera), settings.seed),
      random_(settings.seed),
      active_(detector != nullptr) {
  if (!detector) return;
  log_.info("people: " + detector->name());
  detector_ = std::make_unique<DetectorThread>(std::move(detector), thread_options(settings), timer, log_);
}

void People::check(const RgbdFrame& frame) const {
  const cv::Mat& mask = frame.moving_mask;
  if (mask.empty()) return;
  if (mask.type() != CV_8UC1 || mask.cols != settings_.camera.width || mask.rows != settings_.camera.height)
    throw InputError("moving_mask must be CV_8UC1 and of the images' size");
}

void People::begin(const RgbdFrame& frame, const SE3& expected_motion) {
  ++frame_;
  time_s_ = frame.time_s;
  depth_lag_s_ = time_s_ - frame.depth_time_s.value_or(time_s_);
  depth_ = frame.depth;
  moving_mask_ = frame.moving_mask;
  boxes_collected_ = false;
  active_ = active_ || frame.boxes || !frame.moving_mask.empty();
  if (!active_) return;
  if (detector_ && !frame.boxes) detector_->offer(frame_, time_s_, frame.colour);
  if (uses_tracks()) {
    const auto scope = timer_.time("people: carry");
    tracks_.begin_frame(frame_, time_s_, reduce_depth(depth_, metres_per_unit_), expected_motion);
  }
  if (frame.boxes) {
    ++n_callers_boxes_;
    counts_.boxes += frame.boxes->size();
    boxes_ = *frame.boxes;
    boxes_time_s_ = time_s_;
  }
}

ExtractionPrior People::prior() const {
  ExtractionPrior prior;
  if (active_ && uses_tracks() && !tracks_.tracks().empty()) prior.people = tracks_.labels();
  return prior;
}

void People::collect_boxes() {
  boxes_collected_ = true;
  std::vector<Detections> arrived;
  if (detector_) {
    const auto scope = timer_.time("track: wait for boxes");
    arrived = detector_->collect(time_s_);
  }
  const auto scope = timer_.time("people: fit boxes");
  const bool callers = boxes_time_s_ == time_s_;
  for (Detections& detections : arrived) take(std::move(detections));
  if (callers && uses_tracks()) tracks_.add_detections({frame_, time_s_, boxes_});
  if (!boxes_time_s_) return;
  const double age_s = time_s_ - *boxes_time_s_;
  ++frames_with_boxes_;
  boxes_age_sum_s_ += age_s;
  counts_.max_boxes_age_s = std::max(counts_.max_boxes_age_s, age_s);
}

void People::take(Detections detections) {
  counts_.boxes += detections.boxes.size();
  if (uses_tracks()) tracks_.add_detections(detections);
  if (boxes_time_s_ && detections.time_s < *boxes_time_s_) return;
  boxes_time_s_ = detections.time_s;
  boxes_ = std::move(detections.boxes);
}

std::vector<std::uint8_t> People::filter(const KeypointCandidates& candidates) {
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(candidates.size()), 1);
  if (active_) {
    const std::vector<DepthKeypoint> keypoints = depth_keypoints(candidates);
    if (!boxes_collected_) {
      if (uses_tracks()) {
        const auto scope = timer_.time("people: flow");
        tracks_.set_keypoints({keypoints, candidates.orb.descriptors});
      }
      collect_boxes();
    }
    const auto scope = timer_.time("people: judge keypoints");
    const std::vector<std::uint8_t> marks = judge(keypoints);
    std::transform(marks.begin(), marks.end(), keep.begin(),
                   [](std::uint8_t mark) { return static_cast<std::uint8_t>(mark == 0); });
  }
  last_candidates_ = keep.size();
  last_removed_ = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), std::uint8_t{0}));
  return keep;
}

std::vector<std::uint8_t> People::judge(const std::vector<DepthKeypoint>& keypoints) {
  std::vector<std::uint8_t> marks;
  switch (settings_.people.filter) {
    case PeopleFilter::kSdf:
      marks = find_keypoints_on_people(tracks_.camera(), tracks_.depth_m(), tracks_.tracks(), depth_lag_s_,
                                       keypoints);
      if (settings_.people.reinstate_still) reinstate(keypoints, marks);
      break;
    case PeopleFilter::kPaper:
      marks = find_keypoints_as_published(boxes_, keypoints, random_);
      break;
    case PeopleFilter::kBoxes:
      marks = find_keypoints_in_boxes(boxes_, keypoints);
      break;
  }
  add_moving_mask(keypoints, marks);
  return marks;
}

void People::reinstate(const std::vector<DepthKeypoint>& keypoints, std::vector<std::uint8_t>& marks) {
  const std::vector<std::uint8_t> resting =
      find_keypoints_on_resting_people(tracks_.camera(), tracks_.still().age, tracks_.tracks(), keypoints);
  last_reinstated_ = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == 0 || resting[i] == 0) continue;
    marks[i] = 0;
    ++last_reinstated_;
  }
}

void People::add_moving_mask(const std::vector<DepthKeypoint>& keypoints,
                             std::vector<std::uint8_t>& marks) const {
  if (moving_mask_.empty()) return;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const cv::Point at(static_cast<int>(std::lround(keypoints[i].x)),
                       static_cast<int>(std::lround(keypoints[i].y)));
    const bool inside = cv::Rect({}, moving_mask_.size()).contains(at);
    if (inside && moving_mask_.at<std::uint8_t>(at) != 0) marks[i] = 1;
  }
}

int People::missing_keypoints(const std::vector<std::uint8_t>& keep) {
  if (!active_ || !uses_tracks() || last_removed_ == 0) return 0;
  const auto kept = static_cast<int>(keep.size() - last_removed_);
  const int wanted = std::min(kEnoughKeypoints, settings_.orb.n_features);
  if (kept >= wanted) return 0;
  if (counts_.extended_frames++ == 0) {
    log_.info("people leave only " + std::to_string(kept) +
              " keypoints: more are extracted outside them, here and wherever there are fewer than " +
              std::to_string(wanted));
  }
  return wanted - kept;
}

cv::Mat People::excluded() const {
  if (moving_mask_.empty()) return tracks_.labels();
  cv::Mat mask = person_mask(tracks_.camera(), tracks_.tracks(), depth_, metres_per_unit_);
  mask.setTo(255, moving_mask_);
  return mask;
}

cv::Mat People::moving() const {
  if (!active_) return {};
  cv::Mat1b mask(depth_.size(), std::uint8_t{0});
  const auto add_box = [&mask](const PersonBox& box) {
    const cv::Rect image({}, mask.size());
    const cv::Rect2d inside = cv::Rect2d(box.x, box.y, box.width, box.height) & cv::Rect2d(image);
    if (inside.width > 0.0 && inside.height > 0.0) mask(cv::Rect(inside) & image).setTo(255);
  };
  if (uses_tracks()) {
    mask = person_mask(tracks_.camera(), tracks_.tracks(), depth_, metres_per_unit_);
    for (const PersonTrack& track : tracks_.tracks()) add_box(track.box);
  }
  if (!uses_tracks() || boxes_time_s_ == time_s_) {
    for (const PersonBox& box : boxes_) add_box(box);
  }
  if (!moving_mask_.empty()) mask.setTo(255, moving_mask_);
  return mask;
}

void People::end(const SE3& motion, bool pose_known) {
  counts_.keypoints += last_candidates_;
  counts_.removed_keypoints += last_removed_;
  counts_.reinstated_keypoints += last_reinstated_;
  if (!active_ || !uses_tracks()) return;
  const auto scope = timer_.time("people: look for movers");
  tracks_.end_frame(motion, pose_known);
}

void People::finish() {
  if (detector_) detector_->finish();
}

void People::show(FrameView& view) const {
  view.boxes = boxes_;
  view.boxes_time_s = boxes_time_s_;
  if (!active_) return;
  if (uses_tracks()) {
    view.person_mask = person_mask(tracks_.camera(), tracks_.tracks(), depth_, metres_per_unit_);
  } else {
    view.person_mask = cv::Mat::zeros(depth_.size(), CV_8UC1);
  }
}

std::vector<PersonShape> People::shapes(const SE3& world_from_camera) const {
  if (!active_ || !uses_tracks()) return {};
  return person_shapes(tracks_.camera(), tracks_.tracks(), world_from_camera);
}

PeopleStatistics People::statistics() const {
  PeopleStatistics statistics = counts_;
  statistics.detections = n_callers_boxes_ + (detector_ ? detector_->n_detections() : 0);
  statistics.detector_failures = detector_ ? detector_->n_failures() : 0;
  statistics.detector_stuck = detector_ && detector_->is_stuck();
  if (frames_with_boxes_ > 0)
    statistics.mean_boxes_age_s = boxes_age_sum_s_ / static_cast<double>(frames_with_boxes_);
  return statistics;
}

}  // namespace cpslam
