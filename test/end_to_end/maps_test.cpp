// Maps that are saved, loaded, localised in and mapped on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "end_to_end/clip.h"
#include "features/frame_features.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "io/trajectory_error.h"
#include "map/map_file.h"
#include "place/vocabulary_file.h"
#include "place/vocabulary_training.h"
#include "slam/frame_input.h"
#include "support/half_size.h"

namespace cpslam::e2e {
namespace {

using testing::HasSubstr;

// Where a place is wrong it is wrong by decimetres; a small noisy image is a little less exact than that.
constexpr double kSamePlaceM = 0.05;
constexpr double kAteM = 0.02;

/// A camera on a path through the office of a seed; other noise in every walk.
Clip walk(const std::string& preset, int n_frames, std::uint64_t noise_seed, std::uint64_t room = 1,
          double start_s = 0.0) {
  sim::SimulationOptions options;
  options.preset = preset;
  options.seed = room;
  options.noise_seed = noise_seed;
  options.sensor_noise = true;
  options.n_frames = n_frames;
  options.start_s = start_s;
  options.camera.fps = 15.0;
  test::halve(options.camera);
  return render_clip(options);
}

void append(Clip& clip, const Clip& more) {
  for (ClipFrame frame : more.frames) {
    frame.time_s = clip.frames.back().time_s + 1.0 / clip.settings.camera.fps;
    clip.frames.push_back(frame);
  }
}

/// The camera goes along the path for so many frames and comes back: past where a map of its beginning ends.
Clip there_and_back(const std::string& preset, std::size_t n_frames) {
  Clip clip = walk(preset, static_cast<int>(n_frames), 5);
  Clip back = clip;
  std::reverse(back.frames.begin(), back.frames.end());
  append(clip, back);
  return clip;
}

void save_map_of(const Clip& clip, const std::string& path) {
  System system(clip.settings);
  (void)track_all(system, clip);
  system.save_map(path);
}

Settings in_map(const Clip& clip, const std::string& map, bool localization) {
  Settings settings = clip.settings;
  settings.load_map = map;
  settings.localization = localization;
  return settings;
}

MapFile read_map(const std::string& path, const Settings& settings) {
  return load_map_file(path, settings.camera, settings.orb);
}

/// A map of the office, made once for all tests. Its world begins at the camera's first pose.
class Maps : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    mapped_ = new Clip(walk("office_halfsphere", 150, 1));
    System system(mapped_->settings);
    (void)track_all(system, *mapped_);
    system.shutdown();
    system.save_map(path());
    made_ = new Statistics(system.statistics());
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete mapped_;
    delete made_;
  }
  static std::string path() { return folder_->file("office.map"); }
  static std::string file(const std::string& name) { return folder_->file(name); }

  /// Largest distance between where tracked frames are and where the map's world says the camera was.
  static double worst_m(const std::vector<TrackResult>& results, const Clip& clip) {
    double worst = 0.0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (!is_tracked(results[i].state)) continue;
      worst = std::max(worst, position_error_m(results[i], clip.frames[i], mapped_->frames[0]));
    }
    return worst;
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline Clip* mapped_ = nullptr;
  static inline Statistics* made_ = nullptr;
};

TEST_F(Maps, LoadedAndSavedAgainAMapIsTheSameToTheByte) {
  const System system(in_map(*mapped_, path(), false));
  system.save_map(file("again.map"));
  EXPECT_EQ(TemporaryFolder::content(file("again.map")), TemporaryFolder::content(path()));
  const Statistics statistics = system.statistics();
  EXPECT_EQ(statistics.keyframes, made_->keyframes);
  EXPECT_EQ(statistics.keyframes_created, made_->keyframes_created);
  EXPECT_EQ(statistics.map_points, made_->map_points);
  EXPECT_EQ(statistics.map_points_created, made_->map_points_created);
  EXPECT_EQ(read_map(path(), mapped_->settings).sessions[0].frames.size(), made_->tracked);
}

TEST_F(Maps, LocalisesAlongAnotherPath) {
  const std::string before = TemporaryFolder::content(path());
  const Clip clip = walk("office_xyz", 100, 2);
  System system(in_map(clip, path(), true));
  const std::vector<TrackResult> results = track_all(system, clip);
  system.shutdown();
  const Statistics statistics = system.statistics();
  RecordProperty("tracked", static_cast<int>(statistics.tracked));
  RecordProperty("worst_m", std::to_string(worst_m(results, clip)));
  const TrajectoryError error = absolute_trajectory_error(clip.truth(), system.trajectory());
  RecordProperty("ate_rmse_m", std::to_string(error.rmse_m));
  EXPECT_LE(error.rmse_m, kAteM);
  EXPECT_GE(statistics.tracked, 99U);
  EXPECT_LT(worst_m(results, clip), kSamePlaceM);
  ASSERT_TRUE(statistics.loaded_map.has_value());
  EXPECT_EQ(statistics.loaded_map->keyframes, made_->keyframes);
  EXPECT_EQ(statistics.loaded_map->points, made_->map_points);
  EXPECT_FALSE(statistics.loaded_map->other_vocabulary);
  EXPECT_LE(statistics.loaded_map->frames_before_found, 1U);
  EXPECT_EQ(statistics.keyframes_created, made_->keyframes_created);
  EXPECT_EQ(statistics.map_points_created, made_->map_points_created);
  EXPECT_TRUE(system.keyframe_trajectory().empty()) << "those of the map are of another time";
  system.save_map(file("unchanged.map"));
  const MapFile unchanged = read_map(file("unchanged.map"), clip.settings);
  const MapFile original = read_map(path(), clip.settings);
  EXPECT_EQ(unchanged.sessions[0].points.size(), original.sessions[0].points.size());
  for (std::size_t i = 0; i < original.sessions[0].points.size(); ++i)
    ASSERT_EQ(unchanged.sessions[0].points[i].visible, original.sessions[0].points[i].visible);
  EXPECT_EQ(TemporaryFolder::content(path()), before) << "the file is not written to";
}

TEST_F(Maps, MappingGoesOnInALoadedMap) {
  const Clip clip = walk("office_rpy", 100, 3);
  std::vector<TrackResult> results;
  std::size_t tracked = 0;
  {
    System system(in_map(clip, path(), false));
    results = track_all(system, clip);
    system.shutdown();
    const Statistics statistics = system.statistics();
    tracked = statistics.tracked;
    EXPECT_GE(tracked, 98U);
    EXPECT_LT(worst_m(results, clip), kSamePlaceM);
    EXPECT_GT(statistics.keyframes_created, made_->keyframes_created);
    const Trajectory keyframes = system.keyframe_trajectory();
    ASSERT_FALSE(keyframes.empty());
    EXPECT_LE(keyframes.size(), statistics.keyframes_created - made_->keyframes_created);
    EXPECT_GE(keyframes.front().time_s, clip.frames.front().time_s);
    EXPECT_EQ(system.trajectory().size(), tracked) << "of this run alone";
    system.save_map(file("more.map"));
  }
  EXPECT_EQ(read_map(file("more.map"), clip.settings).sessions[0].frames.size(), made_->tracked + tracked)
      << "of both runs";
  System system(in_map(clip, file("more.map"), true));
  results = track_all(system, clip);
  EXPECT_EQ(system.statistics().tracked, clip.frames.size());
  EXPECT_LT(worst_m(results, clip), kSamePlaceM);
}

TEST_F(Maps, ALoadedMapBehavesLikeTheOneThatWasSaved) {
  // Both go on with the same frames, one with the map it made, the other with what the file has of it.
  const Clip more = walk("office_halfsphere", 60, 4, 1, 10.0);
  Clip whole = *mapped_;
  append(whole, more);
  System made(whole.settings);
  const std::vector<TrackResult> in_made = track_all(made, whole);
  System loaded(in_map(more, path(), false));
  const std::vector<TrackResult> in_loaded = track_all(loaded, more);
  for (std::size_t i = 0; i < more.frames.size(); ++i) {
    ASSERT_TRUE(is_tracked(in_loaded[i].state)) << i;
    const TrackResult& other = in_made[mapped_->frames.size() + i];
    const SE3 apart =
        from_pose(other.world_from_camera).inverse() * from_pose(in_loaded[i].world_from_camera);
    EXPECT_LT(apart.translation.norm(), 0.01) << i;
    EXPECT_LT(rotation_angle(apart.rotation), 0.01) << i;
  }
}

TEST_F(Maps, WhereTheMapShowsNothingPosesAreCarriedOn) {
  const std::string small = file("small.map");
  const Clip view = walk("office_rounds", 20, 1);
  save_map_of(view, small);
  constexpr std::size_t kOut = 120;
  const Clip clip = there_and_back("office_rounds", kOut);
  System system(in_map(clip, small, true));
  const std::vector<TrackResult> results = track_all(system, clip);
  const Statistics statistics = system.statistics();
  RecordProperty("bridged", static_cast<int>(statistics.bridged));
  EXPECT_EQ(statistics.tracked, clip.frames.size());
  EXPECT_GT(statistics.bridged, 100U);
  EXPECT_TRUE(results[kOut].bridged);
  double worst = 0.0;
  for (std::size_t i = 0; i < clip.frames.size(); ++i)
    worst = std::max(worst, position_error_m(results[i], clip.frames[i], view.frames[0]));
  RecordProperty("worst_m", std::to_string(worst));
  EXPECT_LT(worst, 0.15) << "what is bridged drifts";
  EXPECT_FALSE(results.front().bridged);
  for (std::size_t i = clip.frames.size() - 10; i < clip.frames.size(); ++i) {
    EXPECT_FALSE(results[i].bridged) << i;
    EXPECT_LT(position_error_m(results[i], clip.frames[i], view.frames[0]), kSamePlaceM) << i;
  }
  System mapping(in_map(clip, small, false));
  for (const TrackResult& result : track_all(mapping, clip)) EXPECT_FALSE(result.bridged);
}

TEST_F(Maps, WhoSwitchesToMappingOutsideTheMapIsCarriedBackToIt) {
  const std::string small = file("small.map");
  const Clip view = walk("office_rounds", 20, 1);
  save_map_of(view, small);
  constexpr std::size_t kOut = 80;
  const Clip clip = there_and_back("office_rounds", kOut);
  System system(in_map(clip, small, true));
  const std::size_t loaded = system.statistics().keyframes_created;
  std::size_t last_bridged = 0;
  std::size_t first_keyframe = 0;
  TrackResult last;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    if (i == kOut) system.set_localization(false);
    const ClipFrame& frame = clip.frames[i];
    const TrackResult result = system.track(frame.colour, frame.depth, frame.time_s);
    EXPECT_TRUE(is_tracked(result.state)) << i;
    if (result.bridged) last_bridged = i;
    if (result.keyframe && first_keyframe == 0) first_keyframe = i;
    EXPECT_TRUE(i != kOut || result.bridged);
    last = result;
  }
  EXPECT_GT(last_bridged, kOut);
  EXPECT_GT(first_keyframe, last_bridged) << "nothing is mapped before the map is found again";
  EXPECT_GT(system.statistics().keyframes_created, loaded);
  EXPECT_LT(position_error_m(last, clip.frames.back(), view.frames[0]), kSamePlaceM);
}

TEST_F(Maps, InAnotherRoomNothingIsRecognised) {
  // And a covered lens is where the camera gets lost again, and found.
  Clip clip = walk("office_halfsphere", 40, 6, 2);
  const std::size_t other_room = clip.frames.size();
  append(clip, walk("office_xyz", 40, 7));
  for (ClipFrame& frame : clip.frames) frame.time_s -= clip.frames.front().time_s;
  for (std::size_t i = other_room + 15; i < other_room + 25; ++i)
    clip.frames[i].colour = cv::Mat::zeros(clip.frames[i].colour.size(), CV_8UC3);
  for (const bool localization : {true, false}) {
    System system(in_map(clip, path(), localization));
    const std::vector<TrackResult> results = track_all(system, clip);
    for (std::size_t i = 0; i < other_room; ++i) EXPECT_EQ(results[i].state, TrackingState::kLost) << i;
    EXPECT_LT(worst_m(results, clip), kSamePlaceM);
    const LoadedMapStatistics loaded = *system.statistics().loaded_map;
    ASSERT_TRUE(loaded.found_time_s.has_value());
    EXPECT_GE(*loaded.found_time_s, clip.frames[other_room].time_s);
    EXPECT_LE(loaded.frames_before_found, other_room + 3);
    EXPECT_TRUE(is_tracked(results.back().state)) << "found again behind the covered lens";
    EXPECT_FALSE(is_tracked(results[other_room + 24].state));
  }
}

TEST_F(Maps, AnotherVocabularyWillDo) {
  FrameFeaturesBuilder builder(mapped_->settings.camera, mapped_->settings.orb);
  std::vector<ImageDescriptors> images;
  for (std::size_t i = 0; i < mapped_->frames.size(); i += 10) {
    const ClipFrame& frame = mapped_->frames[i];
    images.push_back(builder.build(to_grey(frame.colour), frame.depth)->descriptors);
  }
  VocabularyTrainingOptions options;
  options.depth = 3;
  save_vocabulary(file("other.voc"), train_vocabulary(images, options));
  const Clip clip = walk("office_xyz", 20, 8);
  Settings settings = in_map(clip, path(), true);
  settings.vocabulary = file("other.voc");
  std::string messages;
  System system(settings, [&](LogLevel, const std::string& message) { messages += message + "\n"; });
  EXPECT_THAT(messages, HasSubstr("another vocabulary"));
  const std::vector<TrackResult> results = track_all(system, clip);
  EXPECT_TRUE(system.statistics().loaded_map->other_vocabulary);
  EXPECT_GE(system.statistics().tracked, clip.frames.size() - 1);
  EXPECT_LT(worst_m(results, clip), kSamePlaceM);
}

TEST_F(Maps, CanBeSavedWhileTheMapperWorks) {
  Settings settings = mapped_->settings;
  settings.sequential = false;
  System system(settings);
  for (std::size_t i = 0; i < 80; ++i) {
    const ClipFrame& frame = mapped_->frames[i];
    (void)system.track(frame.colour, frame.depth, frame.time_s);
    if (i % 10 != 9) continue;
    system.save_map(file("running.map"));
    const MapFile map = read_map(file("running.map"), settings);
    EXPECT_EQ(map.sessions[0].frames.size(), system.statistics().tracked);
  }
}

TEST_F(Maps, WhatCannotBe) {
  const Clip clip = walk("office_xyz", 1, 9);
  EXPECT_THAT(input_error([&] { System(in_map(clip, "", true)); }), HasSubstr("load_map"));
  Settings no_vocabulary = in_map(clip, path(), true);
  no_vocabulary.vocabulary.clear();
  EXPECT_THAT(input_error([&] { System{no_vocabulary}; }), HasSubstr("vocabulary"));
  Settings other_camera = in_map(clip, path(), true);
  other_camera.camera.fx += 1.0;
  EXPECT_THAT(input_error([&] { System{other_camera}; }), HasSubstr("another camera"));
  EXPECT_THAT(input_error([&] { System(in_map(clip, file("absent.map"), true)); }), HasSubstr("absent.map"));
  const System empty(clip.settings);
  EXPECT_THAT(error_text<RunError>([&] { empty.save_map(path()); }), HasSubstr("no map to save"));
  EXPECT_NO_THROW((void)read_map(path(), clip.settings)) << "the old one is still there";
  EXPECT_THAT(
      error_text<RunError>([&] { System(in_map(clip, path(), true)).save_map("/no/such/folder/a.map"); }),
      HasSubstr("/no/such/folder"));
  MapFile none = read_map(path(), clip.settings);
  none.sessions.clear();
  save_map_file(file("none.map"), none);
  EXPECT_THAT(input_error([&] { System(in_map(clip, file("none.map"), true)); }),
              AllOf(HasSubstr("none.map"), HasSubstr("no map in it")));
}

}  // namespace
}  // namespace cpslam::e2e
