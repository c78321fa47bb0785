#include "slam/places.h"

#include <gtest/gtest.h>

#include "place/vocabulary_training.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

TEST(Places, RemembersAKeyframeByWhatItShows) {
  Random random(81);
  scene::MappedWorld mapped(200, {SE3()}, {}, random);
  VocabularyTrainingOptions options;
  options.depth = 2;
  Places places(train_vocabulary(std::vector<ImageDescriptors>{mapped.world.descriptors, {}}, options));
  const KeyFrameId id = mapped.keyframes[0];
  places.remember(mapped.map, id);
  ASSERT_EQ(places.database.size(), 1U);
  const BowVector expected = places.vocabulary.transform(mapped.views[0].features->descriptors).bow;
  EXPECT_NEAR(score(places.database.words(id)->bow, expected), 1.0, 1e-5);
  EXPECT_EQ(places.database.candidates(mapped.map, expected, {}).front().keyframe, id);
}

TEST(Places, WhatIsGoneIsNotRemembered) {
  Random random(82);
  scene::MappedWorld mapped(50, {SE3()}, {}, random);
  Places places(train_vocabulary(std::vector<ImageDescriptors>{mapped.world.descriptors}, {}));
  places.remember(mapped.map, KeyFrameId{});
  EXPECT_EQ(places.database.size(), 0U);
}

}  // namespace
}  // namespace cpslam
