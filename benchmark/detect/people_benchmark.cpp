#include <benchmark/benchmark.h>

#include <algorithm>
#include <deque>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "detect/depth_grid.h"
#include "detect/keypoint_filter.h"
#include "detect/person_carry.h"
#include "detect/person_fit.h"
#include "detect/person_flow.h"
#include "detect/person_mask.h"
#include "detect/person_tracks.h"
#include "features/frame_features.h"
#include "sim/simulation.h"

// What people cost per frame: six of them walk through a simulated office. Times are means over the frames of
// the clip; all of one thread, so that on a busy machine the column CPU is the one to read.

namespace cpslam {
namespace {

constexpr int kFrames = 40;
constexpr int kPeople = 6;
constexpr int kRounds = 5;  // over the clip, in each repetition

struct ClipFrame {
  double time_s = 0.0;
  cv::Mat depth;
  FlowKeypoints keypoints;
  std::vector<PersonBox> boxes;
  SE3 this_from_previous;
};

struct Clip {
  CameraSettings camera;
  double metres_per_unit = 0.0;
  std::vector<ClipFrame> frames;
};

FlowKeypoints extract(FrameFeaturesBuilder& builder, const sim::SimulatedFrame& frame) {
  cv::Mat grey;
  cv::cvtColor(frame.colour_bgr, grey, cv::COLOR_BGR2GRAY);
  const KeypointCandidates& candidates = builder.extract(grey, frame.depth);
  FlowKeypoints result;
  result.descriptors = candidates.orb.descriptors;
  for (std::size_t i = 0; i < candidates.orb.keypoints.size(); ++i) {
    const OrbKeypoint& k = candidates.orb.keypoints[i];
    result.keypoints.push_back({k.x, k.y, candidates.depth[i].depth_m});
  }
  return result;
}

Clip simulate() {
  sim::SimulationOptions options;
  options.preset = "walking_xyz";
  options.n_people = kPeople;
  options.n_frames = kFrames;
  options.sensor_noise = true;
  sim::Simulation simulation(options);
  Clip clip{simulation.camera(), 1.0 / simulation.camera().depth_map_factor, {}};
  FrameFeaturesBuilder builder(clip.camera, simulation.settings().orb);
  for (int i = 0; i < simulation.size(); ++i) {
    const sim::SimulatedFrame frame = simulation.render(i);
    const SE3 motion =
        i == 0 ? SE3() : frame.world_from_camera.inverse() * simulation.world_from_camera(i - 1);
    clip.frames.push_back({frame.time_s, frame.depth, extract(builder, frame), frame.boxes(), motion});
  }
  return clip;
}

/// Simulated by the first benchmark that asks for it.
const Clip& shared_clip() {
  static const Clip clip = simulate();
  return clip;
}

/// When boxes arrive.
struct Lateness {
  double rate_hz = 0.0;  // 0: with every frame
  double delay_s = 0.0;
};

/// The clip through PersonTracks, as People takes a sequence through it.
class Walk {
 public:
  Walk(const Clip& clip, const Lateness& lateness)
      : clip_(clip), lateness_(lateness), tracks_(PinholeCamera(clip.camera), 0) {}

  /// The next frame; how many of its keypoints are on people.
  std::size_t step() {
    const ClipFrame& frame = clip_.frames[next_];
    // As a motion model expects it: as before.
    const SE3& expected = clip_.frames[next_ > 0 ? next_ - 1 : 0].this_from_previous;
    tracks_.begin_frame(next_, frame.time_s, reduce_depth(frame.depth, clip_.metres_per_unit), expected);
    benchmark::DoNotOptimize(tracks_.labels());
    tracks_.set_keypoints(frame.keypoints);
    add_boxes(frame);
    const std::vector<std::uint8_t> marks = find_keypoints_on_people(
        tracks_.camera(), tracks_.depth_m(), tracks_.tracks(), 0.0, frame.keypoints.keypoints);
    tracks_.end_frame(frame.this_from_previous, true);
    ++next_;
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), std::uint8_t{1}));
  }
  [[nodiscard]] bool at_end() const { return next_ == clip_.frames.size(); }
  [[nodiscard]] const PersonTracks& tracks() const { return tracks_; }

 private:
  void add_boxes(const ClipFrame& frame) {
    constexpr double kStampsS = 1e-6;
    const double due_s = next_detection_s_ - kStampsS;
    if (lateness_.rate_hz <= 0.0 || frame.time_s >= due_s) {
      on_their_way_.push_back({next_, frame.time_s, frame.boxes});
      if (lateness_.rate_hz > 0.0) next_detection_s_ = frame.time_s + 1.0 / lateness_.rate_hz;
    }
    while (!on_their_way_.empty() &&
           on_their_way_.front().time_s + lateness_.delay_s <= frame.time_s + kStampsS) {
      tracks_.add_detections(on_their_way_.front());
      on_their_way_.pop_front();
    }
  }

  const Clip& clip_;
  const Lateness lateness_;
  PersonTracks tracks_;
  std::deque<Detections> on_their_way_;
  double next_detection_s_ = 0.0;
  std::size_t next_ = 0;
};

void filter_and_tracks(benchmark::State& state, Lateness lateness) {
  const Clip& clip = shared_clip();
  std::optional<Walk> walk(std::in_place, clip, lateness);
  std::size_t removed = 0;
  for (auto _ : state) {
    if (walk->at_end()) {
      state.PauseTiming();
      walk.emplace(clip, lateness);
      state.ResumeTiming();
    }
    removed += walk->step();
  }
  state.counters["removed"] =
      benchmark::Counter(static_cast<double>(removed), benchmark::Counter::kAvgIterations);
}

BENCHMARK_CAPTURE(filter_and_tracks, wait, Lateness{})
    ->Iterations(kRounds* kFrames)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(filter_and_tracks, late_6_per_s_150_ms, Lateness{6.0, 0.15})
    ->Iterations(kRounds* kFrames)
    ->Unit(benchmark::kMillisecond);

/// What a part gets to work on in a frame, boxes being there at once.
struct Moment {
  cv::Mat1f depth_m;
  StillSurface still;
  std::vector<PersonTrack> tracks;
  std::vector<KnownBox> boxes;
};

/// A person's track takes over the box of his detection.
KnownBox known_box(const PersonBox& box, const std::vector<PersonTrack>& tracks) {
  const auto found = std::find_if(tracks.begin(), tracks.end(), [&box](const PersonTrack& track) {
    return track.box.x == box.x && track.box.y == box.y;
  });
  if (found == tracks.end()) return {box};
  return {box, found->number, is_walking(*found)};
}

std::vector<Moment> moments(const Clip& clip) {
  const GridCamera camera{PinholeCamera(clip.camera)};
  Walk walk(clip, {});
  std::vector<Moment> result;
  for (const ClipFrame& frame : clip.frames) {
    walk.step();
    Moment moment;
    moment.depth_m = walk.tracks().depth_m();
    moment.still = result.empty()
                       ? StillSurface::begin(moment.depth_m)
                       : result.back().still.carry(camera, moment.depth_m, frame.this_from_previous);
    moment.tracks = walk.tracks().tracks();
    moment.still.claim(paint_people(moment.tracks, camera.size()));
    for (const PersonBox& box : frame.boxes) moment.boxes.push_back(known_box(box, moment.tracks));
    result.push_back(std::move(moment));
  }
  return result;
}

/// Calls part(index) for index 1 .. last over and over.
template <typename Part>
void over_the_clip(benchmark::State& state, const Part& part) {
  std::size_t index = 1;
  for (auto _ : state) {
    part(index);
    index = index + 1 < kFrames ? index + 1 : 1;
  }
}

void mask(benchmark::State& state) {
  const Clip& clip = shared_clip();
  const GridCamera camera{PinholeCamera(clip.camera)};
  const std::vector<Moment> known = moments(clip);
  over_the_clip(state, [&](std::size_t i) {
    benchmark::DoNotOptimize(
        person_mask(camera, known[i].tracks, clip.frames[i].depth, clip.metres_per_unit).data);
  });
}
BENCHMARK(mask)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

void part_reduce_depth(benchmark::State& state) {
  const Clip& clip = shared_clip();
  over_the_clip(state, [&](std::size_t i) {
    benchmark::DoNotOptimize(reduce_depth(clip.frames[i].depth, clip.metres_per_unit).data);
  });
}
BENCHMARK(part_reduce_depth)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

void part_still_surface(benchmark::State& state) {
  const Clip& clip = shared_clip();
  const GridCamera camera{PinholeCamera(clip.camera)};
  const std::vector<Moment> known = moments(clip);
  over_the_clip(state, [&](std::size_t i) {
    benchmark::DoNotOptimize(
        known[i - 1].still.carry(camera, known[i].depth_m, clip.frames[i].this_from_previous).age.data);
  });
}
BENCHMARK(part_still_surface)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

void part_carry_people(benchmark::State& state) {
  const Clip& clip = shared_clip();
  const GridCamera camera{PinholeCamera(clip.camera)};
  const std::vector<Moment> known = moments(clip);
  over_the_clip(state, [&](std::size_t i) {
    const ClipFrame& frame = clip.frames[i];
    std::vector<PersonTrack> tracks = known[i - 1].tracks;
    carry_people(camera,
                 {known[i].depth_m, known[i].still, frame.this_from_previous, frame.time_s,
                  frame.time_s - clip.frames[i - 1].time_s},
                 tracks);
    benchmark::DoNotOptimize(tracks.data());
  });
}
BENCHMARK(part_carry_people)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

void part_flow(benchmark::State& state) {
  const Clip& clip = shared_clip();
  const GridCamera camera{PinholeCamera(clip.camera)};
  const std::vector<Moment> known = moments(clip);
  over_the_clip(state, [&](std::size_t i) {
    const ClipFrame& frame = clip.frames[i];
    std::vector<PersonTrack> tracks = known[i].tracks;
    follow_keypoints(camera, clip.frames[i - 1].keypoints, paint_people(known[i - 1].tracks, camera.size()),
                     frame.keypoints, frame.this_from_previous, frame.time_s - clip.frames[i - 1].time_s,
                     tracks);
    benchmark::DoNotOptimize(tracks.data());
  });
}
BENCHMARK(part_flow)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

void part_fit_boxes(benchmark::State& state) {
  const Clip& clip = shared_clip();
  const GridCamera camera{PinholeCamera(clip.camera)};
  const std::vector<Moment> known = moments(clip);
  Random random(0);
  over_the_clip(state, [&](std::size_t i) {
    const cv::Mat1b people = paint_people(known[i - 1].tracks, camera.size());
    benchmark::DoNotOptimize(fit_people(camera, {known[i].depth_m, people, known[i].still}, known[i].boxes,
                                        clip.frames[i].keypoints.keypoints, random)
                                 .data());
  });
}
BENCHMARK(part_fit_boxes)->Iterations(kRounds* kFrames)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cpslam
