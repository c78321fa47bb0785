#include "detect/truth.h"

#include <algorithm>
#include <deque>
#include <opencv2/imgproc.hpp>

#include "detect/depth_grid.h"
#include "detect/keypoint_filter.h"
#include "detect/person_mask.h"
#include "detect/person_tracks.h"
#include "features/keypoint_depth.h"
#include "features/orb_extractor.h"
#include "sim/simulation.h"

namespace cpslam {
namespace {

cv::Mat morphed(const cv::Mat& mask, int px, bool grow) {
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * px + 1, 2 * px + 1});
  cv::Mat result;
  if (grow) {
    cv::dilate(mask, result, kernel);
  } else {
    cv::erode(mask, result, kernel);
  }
  return result;
}

std::vector<PersonBox> spoil(const std::vector<PersonBox>& boxes, const TruthOptions& options,
                             Random& random) {
  std::vector<PersonBox> spoilt;
  for (PersonBox box : boxes) {
    if (random.uniform() < options.box_missing) continue;
    const double left = box.x + options.box_jitter * box.width * random.normal();
    const double top = box.y + options.box_jitter * box.height * random.normal();
    const double right = box.x + box.width * (1.0 + options.box_jitter * random.normal());
    const double bottom = box.y + box.height * (1.0 + options.box_jitter * random.normal());
    if (right - left < 4.0 || bottom - top < 4.0) continue;
    box.x = left;
    box.y = top;
    box.width = right - left;
    box.height = bottom - top;
    spoilt.push_back(box);
  }
  return spoilt;
}

FlowKeypoints extract(OrbExtractor& extractor, const sim::SimulatedFrame& frame, double metres_per_unit) {
  cv::Mat grey;
  cv::cvtColor(frame.colour_bgr, grey, cv::COLOR_BGR2GRAY);
  OrbFeatures features;
  extractor.extract(grey, features);
  FlowKeypoints result;
  result.descriptors = features.descriptors;
  for (const OrbKeypoint& k : features.keypoints) {
    const DepthReading reading =
        read_keypoint_depth(frame.depth, metres_per_unit, int(std::lround(k.x)), int(std::lround(k.y)));
    result.keypoints.push_back({k.x, k.y, reading.depth_m});
  }
  return result;
}

void count(const std::vector<DepthKeypoint>& keypoints, const std::vector<std::uint8_t>& removed,
           const cv::Mat& people, const std::vector<PersonBox>& boxes, FilterTruth& truth) {
  const cv::Mat inner = morphed(people, 2, false);
  const cv::Mat outer = morphed(people, 3, true);
  const std::vector<std::uint8_t> boxed = find_keypoints_in_boxes(boxes, keypoints);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const cv::Point at(int(std::lround(keypoints[i].x)), int(std::lround(keypoints[i].y)));
    if (inner.at<std::uint8_t>(at) != 0) {
      ++truth.on_people;
      truth.on_people_removed += removed[i];
    } else if (outer.at<std::uint8_t>(at) != 0) {
      ++truth.rim;
      truth.rim_removed += removed[i];
    } else if (boxed[i] != 0) {
      ++truth.in_boxes;
      truth.in_boxes_kept += removed[i] == 0 ? 1U : 0U;
    } else {
      ++truth.elsewhere;
      truth.elsewhere_kept += removed[i] == 0 ? 1U : 0U;
    }
  }
}

void compare_masks(const cv::Mat& found, const cv::Mat& people, FilterTruth& truth) {
  const cv::Mat a = found != 0;
  const cv::Mat b = people != 0;
  if (cv::countNonZero(b) < 500) return;
  truth.mask_iou_sum += double(cv::countNonZero(a & b)) / double(cv::countNonZero(a | b));
  ++truth.mask_frames;
}

}  // namespace

FilterTruth& FilterTruth::operator+=(const FilterTruth& other) {
  on_people += other.on_people;
  on_people_removed += other.on_people_removed;
  in_boxes += other.in_boxes;
  in_boxes_kept += other.in_boxes_kept;
  rim += other.rim;
  rim_removed += other.rim_removed;
  elsewhere += other.elsewhere;
  elsewhere_kept += other.elsewhere_kept;
  mask_iou_sum += other.mask_iou_sum;
  mask_frames += other.mask_frames;
  return *this;
}

FilterTruth measure_filter(const TruthOptions& options) {
  sim::SimulationOptions simulated;
  simulated.preset = options.preset;
  simulated.seed = options.seed;
  simulated.sensor_noise = true;
  simulated.n_frames = options.n_frames;
  if (options.n_people >= 0) simulated.n_people = options.n_people;
  sim::Simulation simulation(simulated);
  const CameraSettings settings = simulation.camera();
  const double metres_per_unit = 1.0 / settings.depth_map_factor;
  PersonTracks tracks(PinholeCamera(settings), 0);
  OrbExtractor extractor(OrbSettings{});
  Random random(options.seed);
  std::deque<std::pair<double, Detections>> on_their_way;  // when they arrive
  double last_begun_s = -1e9;
  FilterTruth truth;
  for (int i = 0; i < simulation.size(); ++i) {
    const sim::SimulatedFrame frame = simulation.render(i);
    const SE3 moved =
        i == 0 ? SE3() : frame.world_from_camera.inverse() * simulation.world_from_camera(i - 1);
    tracks.begin_frame(std::uint64_t(i), frame.time_s, reduce_depth(frame.depth, metres_per_unit), moved);
    const FlowKeypoints keypoints = extract(extractor, frame, metres_per_unit);
    tracks.set_keypoints(keypoints);
    if (options.detection_rate_hz <= 0.0 ||
        frame.time_s - last_begun_s > 1.0 / options.detection_rate_hz - 1e-6) {
      last_begun_s = frame.time_s;
      on_their_way.push_back({frame.time_s + options.detection_delay_s,
                              {std::uint64_t(i), frame.time_s, spoil(frame.boxes(), options, random)}});
    }
    for (; !on_their_way.empty() && on_their_way.front().first <= frame.time_s + 1e-6;
         on_their_way.pop_front())
      tracks.add_detections(on_their_way.front().second);
    const bool somebody_was_seen = frame.time_s - simulation.time_s(0) >= options.detection_delay_s + 0.1;
    if (somebody_was_seen) {
      count(keypoints.keypoints,
            find_keypoints_on_people(tracks.camera(), tracks.depth_m(), tracks.tracks(), 0.0,
                                     keypoints.keypoints),
            frame.person_mask != 0, frame.boxes(), truth);
      compare_masks(person_mask(tracks.camera(), tracks.tracks(), frame.depth, metres_per_unit),
                    frame.person_mask, truth);
    }
    tracks.end_frame(moved, true);
  }
  return truth;
}

}  // namespace cpslam
