#include "slam/map_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "map/map_file.h"
#include "place/vocabulary_training.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MapArchive : public testing::Test {
 protected:
  [[nodiscard]] Rig loading() const {
    Settings settings = scene::kRig.settings;
    settings.load_map = path;
    return Rig(settings);
  }
  void save(const Places* places = nullptr) const {
    save_map(path, scene::kRig, mapped.map, places, log.frames());
  }
  static Vocabulary vocabulary_of(const std::vector<Descriptor>& descriptors, std::uint64_t seed) {
    VocabularyTrainingOptions options;
    options.depth = 2;
    options.seed = seed;
    return train_vocabulary(std::vector<ImageDescriptors>{descriptors, {}}, options);
  }
  Random random{91};
  scene::MappedWorld mapped{100, scene::row_of_poses(3, 0.1), {}, random};
  const SE3 cam_from_reference = synthetic::moved({}, {0.01, 0.02, 0.03}, 0.1);
  TrajectoryLog log;
  TemporaryFolder folder;
  const std::string path = folder.file("room.map");
  const Log silent{{}};
};

TEST_F(MapArchive, FramesComeBackOnTheirKeyframes) {
  log.add(1.5, mapped.keyframes[1], cam_from_reference);
  log.add(2.5, mapped.keyframes[2], cam_from_reference);
  save();
  Map map(scene::kRig.pyramid);
  const auto loaded = load_map(loading(), map, nullptr, silent);
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->frames.size(), 2U);
  const std::vector<KeyFrameId> ids = map.keyframes_by_sequence();
  EXPECT_EQ(loaded->frames[0].time_s, 1.5);
  EXPECT_EQ(loaded->frames[0].reference, ids[1]);
  EXPECT_EQ(loaded->frames[1].reference, ids[2]);
  EXPECT_EQ(loaded->frames[1].cam_from_reference.translation, cam_from_reference.translation);
  EXPECT_EQ(loaded->next_sequence, 3U);
  EXPECT_EQ(loaded->statistics.keyframes, 3U);
  EXPECT_EQ(loaded->statistics.points, mapped.map.n_points());
}

TEST_F(MapArchive, FramesOfCulledKeyframesHangOnWhatIsAlive) {
  log.add(1.5, mapped.keyframes[2], cam_from_reference);
  const SE3 pose = from_pose(log.resolve(mapped.map)[0].world_from_camera);
  const KeyFrameId parent = mapped.map.keyframe(mapped.keyframes[2])->parent;
  ASSERT_TRUE(mapped.map.erase_keyframe(mapped.keyframes[2]));
  save();
  Map map(scene::kRig.pyramid);
  const auto loaded = load_map(loading(), map, nullptr, silent);
  ASSERT_TRUE(loaded.has_value());
  ASSERT_EQ(loaded->frames.size(), 1U);
  const LoggedFrame& frame = loaded->frames[0];
  EXPECT_EQ(map.keyframe(frame.reference)->sequence, mapped.map.keyframe(parent)->sequence);
  const SE3 again = (frame.cam_from_reference * map.keyframe(frame.reference)->cam_from_world).inverse();
  EXPECT_LT(synthetic::distance(again, pose), 1e-9);
  EXPECT_EQ(loaded->next_sequence, 3U) << "a culled keyframe's sequence is not given out again";
}

TEST_F(MapArchive, WhatIsLoadedIsNoPartOfTheTrajectory) {
  log.add(1.5, mapped.keyframes[0], cam_from_reference);
  TrajectoryLog later(log.frames());
  EXPECT_TRUE(later.resolve(mapped.map).empty());
  later.add(9.5, mapped.keyframes[1], cam_from_reference);
  ASSERT_EQ(later.resolve(mapped.map).size(), 1U);
  EXPECT_EQ(later.resolve(mapped.map)[0].time_s, 9.5);
  EXPECT_EQ(later.frames().size(), 2U);
  EXPECT_EQ(keyframe_poses(mapped.map, 1).size(), 2U);
}

TEST_F(MapArchive, PlacesRememberWhatWasLoaded) {
  const Places made(vocabulary_of(mapped.world.descriptors, 1));
  save(&made);
  for (const std::uint64_t seed : {1U, 2U}) {
    Places places(vocabulary_of(mapped.world.descriptors, seed));
    Map map(scene::kRig.pyramid);
    const auto loaded = load_map(loading(), map, &places, silent);
    ASSERT_TRUE(loaded.has_value());
    EXPECT_EQ(loaded->statistics.other_vocabulary, seed != 1U);
    ASSERT_EQ(places.database.size(), 3U);
    const BowVector bow = places.vocabulary.transform(mapped.views[1].features->descriptors).bow;
    const KeyFrameId id = map.keyframes_by_sequence()[1];
    EXPECT_NEAR(score(places.database.words(id)->bow, bow), 1.0, 1e-5);
  }
}

TEST_F(MapArchive, NothingToLoadOrToSave) {
  Map map(scene::kRig.pyramid);
  EXPECT_FALSE(load_map(scene::kRig, map, nullptr, silent).has_value());
  EXPECT_THAT(error_text<RunError>([&] { save_map(path, scene::kRig, map, nullptr, {}); }),
              AllOf(HasSubstr("room.map"), HasSubstr("no map to save")));
  EXPECT_EQ(folder.file_count(), 0U);
}

TEST_F(MapArchive, EverySessionComesBackWithItsFrames) {
  log.add(1.5, mapped.keyframes[1], cam_from_reference);
  KeyFrame elsewhere;
  elsewhere.session = 2;
  elsewhere.time_s = 7.0;
  elsewhere.features = mapped.views[0].features;
  const KeyFrameId other = mapped.map.add_keyframe(std::move(elsewhere));
  mapped.map.add_point({0.0, 0.0, 2.0}, {other, 3});
  log.add(7.5, other, cam_from_reference);
  log.add(8.5, mapped.keyframes[2], cam_from_reference);
  const Places made(vocabulary_of(mapped.world.descriptors, 1));
  save(&made);
  Places places(vocabulary_of(mapped.world.descriptors, 1));
  Map map(scene::kRig.pyramid);
  const auto loaded = load_map(loading(), map, &places, silent);
  ASSERT_TRUE(loaded.has_value());
  EXPECT_THAT(map.sessions(), testing::ElementsAre(1, 2));
  EXPECT_EQ(loaded->statistics.maps, 2U);
  EXPECT_EQ(loaded->statistics.keyframes, 4U);
  EXPECT_EQ(loaded->statistics.points, mapped.map.n_points());
  EXPECT_EQ(loaded->next_sequence, 4U);
  EXPECT_EQ(places.database.size(), 4U);
  std::vector<std::pair<double, int>> frames;
  for (const LoggedFrame& frame : loaded->frames)
    frames.emplace_back(frame.time_s, map.session_of(frame.reference));
  EXPECT_THAT(frames, testing::ElementsAre(std::pair(1.5, 1), std::pair(8.5, 1), std::pair(7.5, 2)));
}

TEST_F(MapArchive, AFileWithoutAMapIsRefused) {
  save();
  MapFile file = load_map_file(path, scene::kRig.settings.camera, scene::kRig.settings.orb);
  file.sessions.clear();
  save_map_file(path, file);
  Map map(scene::kRig.pyramid);
  EXPECT_THAT(input_error([&] { (void)load_map(loading(), map, nullptr, silent); }),
              AllOf(HasSubstr("room.map"), HasSubstr("no map in it")));
}

}  // namespace
}  // namespace cpslam
