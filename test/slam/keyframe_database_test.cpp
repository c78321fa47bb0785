#include "slam/keyframe_database.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "map/map_builder.h"

namespace cpslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr std::size_t kWords = 100;

class KeyFrameDatabaseTest : public testing::Test {
 protected:
  /// A keyframe whose words from `first` on have equal weights.
  KeyFrameId add(WordId first, std::size_t n = 10) {
    const KeyFrameId id = test::add_keyframe(map_, test::blank_features(200));
    database_.add(id, words(first, n));
    return id;
  }
  static std::shared_ptr<const ImageWords> words(WordId first, std::size_t n = 10) {
    ImageWords image;
    for (std::size_t i = 0; i < n; ++i)
      image.bow.push_back({first + static_cast<WordId>(i), 1.0F / static_cast<float>(n)});
    return std::make_shared<const ImageWords>(std::move(image));
  }
  void connect(KeyFrameId a, KeyFrameId b) {
    test::share_points(map_, a, b, 20);
    map_.update_covisibility(a);
    map_.update_covisibility(b);
  }
  [[nodiscard]] std::vector<KeyFrameId> ask(WordId first, const PlaceQuery& query = {}) const {
    std::vector<KeyFrameId> found;
    for (const PlaceCandidate& candidate : database_.candidates(map_, words(first)->bow, query))
      found.push_back(candidate.keyframe);
    return found;
  }

  Map map_{synthetic::pyramid()};
  KeyFrameDatabase database_{kWords};
};

TEST_F(KeyFrameDatabaseTest, FindsTheKeyframeWithTheSameWords) {
  add(0);
  const KeyFrameId there = add(40);
  add(80);
  const std::vector<PlaceCandidate> found = database_.candidates(map_, words(40)->bow, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].keyframe, there);
  EXPECT_NEAR(found[0].score, 1.0, 1e-6);
  EXPECT_NEAR(found[0].group_score, 1.0, 1e-6);
  EXPECT_EQ(found[0].common_words, 10);
  EXPECT_THAT(ask(20), IsEmpty());
}

TEST_F(KeyFrameDatabaseTest, ScoresAreThoseOfTheBags) {
  std::vector<KeyFrameId> ids;
  for (WordId first = 30; first < 50; ++first) ids.push_back(add(first, 5 + first % 7));
  PlaceQuery query;
  query.max_candidates = 100;
  for (const PlaceCandidate& candidate : database_.candidates(map_, words(40)->bow, query))
    EXPECT_NEAR(candidate.score, score(words(40)->bow, database_.words(candidate.keyframe)->bow), 1e-9);
}

TEST_F(KeyFrameDatabaseTest, FewCommonWordsDoNotCount) {
  const KeyFrameId all = add(40);
  const KeyFrameId eight = add(42);
  add(43);  // seven of ten
  EXPECT_THAT(ask(40), ElementsAre(all, eight));
}

TEST_F(KeyFrameDatabaseTest, ANeighbourhoodCollectsItsScoresAndSendsItsBest) {
  const KeyFrameId alone = add(40);
  const KeyFrameId beside = add(42);
  const KeyFrameId best = add(41);
  const KeyFrameId unlike = add(80);
  connect(beside, best);
  connect(best, unlike);
  const std::vector<PlaceCandidate> found = database_.candidates(map_, words(40)->bow, {});
  // 0.9 + 0.8 beats 1.0, which is less than 0.75 of it.
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].keyframe, best);
  EXPECT_NEAR(found[0].score, 0.9, 1e-6);
  EXPECT_NEAR(found[0].group_score, 1.7, 1e-6);
  (void)alone;
}

TEST_F(KeyFrameDatabaseTest, BestFirstThenTheOlder) {
  const KeyFrameId second = add(41);
  const KeyFrameId third = add(39);
  const KeyFrameId first = add(40);
  EXPECT_THAT(ask(40), ElementsAre(first, second, third));
  PlaceQuery query;
  query.max_candidates = 2;
  EXPECT_THAT(ask(40, query), ElementsAre(first, second));
  query.min_score = 0.95;
  EXPECT_THAT(ask(40, query), ElementsAre(first));
}

TEST_F(KeyFrameDatabaseTest, ExcludedOnesNeitherAnswerNorSetTheMeasure) {
  const KeyFrameId same = add(40);
  const KeyFrameId far = add(45);
  EXPECT_THAT(ask(40), ElementsAre(same));
  PlaceQuery query;
  query.excluded = {same};
  EXPECT_THAT(ask(40, query), ElementsAre(far));
}

TEST_F(KeyFrameDatabaseTest, ErasedOnesAreGone) {
  const KeyFrameId a = add(40);
  const KeyFrameId b = add(40);
  EXPECT_EQ(database_.size(), 2U);
  database_.erase(a);
  database_.erase(a);
  EXPECT_EQ(database_.size(), 1U);
  EXPECT_EQ(database_.words(a), nullptr);
  EXPECT_THAT(ask(40), ElementsAre(b));
}

TEST_F(KeyFrameDatabaseTest, CulledFromTheMapIsNotHandedOut) {
  const KeyFrameId root = add(0);
  const KeyFrameId culled = add(40);
  connect(root, culled);
  ASSERT_TRUE(map_.erase_keyframe(culled));
  EXPECT_THAT(ask(40), IsEmpty());
}

TEST_F(KeyFrameDatabaseTest, NewWordsReplaceTheOld) {
  const KeyFrameId id = add(40);
  database_.add(id, words(0));
  EXPECT_EQ(database_.size(), 1U);
  EXPECT_THAT(ask(40), IsEmpty());
  EXPECT_THAT(ask(0), ElementsAre(id));
}

TEST_F(KeyFrameDatabaseTest, WithoutWordsNothingIsAlike) {
  database_.add(test::add_keyframe(map_, test::blank_features(1)), std::make_shared<const ImageWords>());
  EXPECT_THAT(database_.candidates(map_, {}, {}), IsEmpty());
  EXPECT_THAT(ask(40), IsEmpty());
}

TEST_F(KeyFrameDatabaseTest, SeveralThreadsAtOnce) {
  std::vector<KeyFrameId> ids;
  for (int i = 0; i < 100; ++i) ids.push_back(test::add_keyframe(map_, test::blank_features(1)));
  {
    const std::jthread writer([&] {
      for (int round = 0; round < 20; ++round) {
        for (const KeyFrameId id : ids) database_.add(id, words(id.index % 80));
        for (const KeyFrameId id : ids) database_.erase(id);
      }
      for (const KeyFrameId id : ids) database_.add(id, words(id.index % 80));
    });
    for (int i = 0; i < 200; ++i) (void)ask(static_cast<WordId>(i % 80));
  }
  EXPECT_EQ(database_.size(), 100U);
  EXPECT_THAT(ask(10), testing::Not(IsEmpty()));
}

TEST_F(KeyFrameDatabaseTest, ClearedItKnowsNobodyAndLearnsAnew) {
  const KeyFrameId first = add(10);
  add(12);
  database_.clear();
  EXPECT_EQ(database_.size(), 0U);
  EXPECT_EQ(database_.words(first), nullptr);
  EXPECT_THAT(ask(10), IsEmpty());
  const KeyFrameId later = add(10);
  EXPECT_THAT(ask(10), ElementsAre(later));
}

}  // namespace
}  // namespace cpslam
