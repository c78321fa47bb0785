#include "slam/recovery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "slam/scene.h"

namespace cpslam {
namespace {

using scene::kRig;

/// n keyframes in a chain, each sharing points with the next only.
struct Chain {
  explicit Chain(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<synthetic::Spot> spots(40, {.x = 10.0, .y = 10.0, .descriptor = {}, .depth_m = 2.0});
      KeyFrame keyframe;
      keyframe.features = synthetic::make_features(spots);
      ids.push_back(map.add_keyframe(std::move(keyframe)));
      for (int k = 0; i > 0 && k < 20; ++k) {
        const MapPointId point = map.add_point({0.0, 0.0, 2.0}, {ids[i - 1], 20 + k});
        map.add_observation(point, {ids[i], k});
      }
      map.update_covisibility(ids[i]);
    }
  }
  Map map{kRig.pyramid};
  std::vector<KeyFrameId> ids;
};

/// Words of an image that has one word only.
std::shared_ptr<const ImageWords> one_word(WordId word) {
  ImageWords words;
  words.bow.push_back({word, 1.0F});
  return std::make_shared<const ImageWords>(std::move(words));
}

/// A vocabulary of n words, which these tests give out themselves.
Vocabulary words_only(std::uint32_t n) {
  VocabularyTree tree;
  tree.branching = n;
  tree.depth = 1;
  tree.descriptors.resize(n + 1);
  tree.first_child.assign(n + 2, n + 1);
  tree.first_child[0] = 1;
  tree.word_weights.assign(n, 1.0F);
  return Vocabulary(std::move(tree));
}

TEST(RecoveryCandidates, ReferenceFirstThenTheLatestThenItsNeighbours) {
  const Chain chain(20);
  EXPECT_THAT(recovery_candidates(chain.map, nullptr, chain.ids[10], {}),
              testing::ElementsAre(chain.ids[10], chain.ids[19], chain.ids[18], chain.ids[9], chain.ids[11]));
}

TEST(RecoveryCandidates, ThenThePlacesThatLookAlikeEachOnce) {
  const Chain chain(20);
  Places places(words_only(10));
  places.database.add(chain.ids[3], one_word(7));
  places.database.add(chain.ids[5], one_word(7));
  places.database.add(chain.ids[6], one_word(2));
  places.database.add(chain.ids[19], one_word(7));
  EXPECT_THAT(recovery_candidates(chain.map, &places, chain.ids[10], one_word(7)->bow),
              testing::ElementsAre(chain.ids[10], chain.ids[19], chain.ids[18], chain.ids[9], chain.ids[11],
                                   chain.ids[3], chain.ids[5]));
}

TEST(RecoveryCandidates, ABoundedEffortForEachFrame) {
  const Chain chain(100);
  Places places(words_only(10));
  for (std::size_t i = 0; i < 100; i += 3) places.database.add(chain.ids[i], one_word(7));
  const auto candidates = recovery_candidates(chain.map, &places, chain.ids[0], one_word(7)->bow);
  EXPECT_LE(candidates.size(), 10U);
  EXPECT_EQ(std::set<KeyFrameId>(candidates.begin(), candidates.end()).size(), candidates.size());
}

TEST(RecoveryCandidates, CulledReferenceIsStoodInForByItsAncestor) {
  Chain chain(10);
  ASSERT_TRUE(chain.map.erase_keyframe(chain.ids[5]));
  const auto candidates = recovery_candidates(chain.map, nullptr, chain.ids[5], {});
  EXPECT_EQ(candidates.front(), chain.ids[4]);
  for (const KeyFrameId id : candidates) EXPECT_NE(chain.map.keyframe(id), nullptr);
}

TEST(RecoveryCandidates, EmptyMapHasNone) {
  const Map map(kRig.pyramid);
  const Places places(words_only(10));
  EXPECT_TRUE(recovery_candidates(map, &places, KeyFrameId{}, one_word(3)->bow).empty());
}

TEST(RecoverFromKeyFrame, PlacesAFrameWithoutPrediction) {
  Random random(61);
  scene::MappedWorld mapped(300, {SE3()}, {}, random);
  const SE3 truth = synthetic::moved({}, {0.3, 0.1, -0.1}, 0.15);
  Frame frame = mapped.frame_at(truth, {.depth_share = 0.8, .noise_px = 0.5, .bit_flips = 20}, random);
  const std::vector<int> shown = [&] {
    std::vector<int> of_keypoint(frame.matches.size(), -1);
    for (std::size_t i = 0; i < of_keypoint.size(); ++i) {
      for (std::size_t p = 0; p < mapped.world.points.size(); ++p) {
        if (descriptor_distance(frame.features->descriptors[i], mapped.world.descriptors[p]) <= 20)
          of_keypoint[i] = static_cast<int>(p);
      }
    }
    return of_keypoint;
  }();
  frame.cam_from_world = SE3(so3_exp({1.0, 2.0, 0.5}), {5.0, 5.0, 5.0});  // no idea
  const int inliers = recover_from_keyframe(kRig, mapped.map, mapped.keyframes[0], random, frame);
  EXPECT_GT(inliers, 150);
  EXPECT_LT(synthetic::distance(frame.cam_from_world, truth), 0.01);
  int matches = 0;
  for (std::size_t i = 0; i < frame.matches.size(); ++i) {
    if (frame.matches[i].kind == PointMatch::Kind::kNone) continue;
    ++matches;
    EXPECT_EQ(frame.matches[i].id, mapped.points[static_cast<std::size_t>(shown[i])]);
  }
  EXPECT_EQ(matches, inliers);
}

TEST(RecoverFromKeyFrame, AStrangePlaceIsNotRecognised) {
  Random random(62);
  scene::MappedWorld here(300, {SE3()}, {}, random);
  scene::MappedWorld elsewhere(300, {SE3()}, {}, random);
  Frame frame = elsewhere.frame_at({}, {}, random);
  EXPECT_EQ(recover_from_keyframe(kRig, here.map, here.keyframes[0], random, frame), 0);
  for (const PointMatch& match : frame.matches) EXPECT_EQ(match.kind, PointMatch::Kind::kNone);
  EXPECT_EQ(recover_from_keyframe(kRig, here.map, KeyFrameId{}, random, frame), 0);
}

}  // namespace
}  // namespace cpslam
