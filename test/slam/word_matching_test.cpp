#include "slam/word_matching.h"

#include <gtest/gtest.h>

#include <numeric>

#include "place/vocabulary_training.h"
#include "slam/scene.h"

namespace cpslam {
namespace {

class WordMatching : public testing::Test {
 protected:
  WordMatching() {
    Random random(71);
    world = synthetic::random_world(400, random);
    a = synthetic::look(world, {}, {.noise_px = 0.2, .bit_flips = 8}, random);
    b = synthetic::look(world, {}, {.noise_px = 0.2, .bit_flips = 8}, random);
    VocabularyTrainingOptions options;
    options.branching = 8;
    options.depth = 3;
    const std::vector<ImageDescriptors> images{a.features->descriptors};
    const Vocabulary vocabulary = train_vocabulary(images, options);
    words_a = vocabulary.transform(a.features->descriptors, 1);
    words_b = vocabulary.transform(b.features->descriptors, 1);
    all_a.resize(a.point_of.size());
    all_b.resize(b.point_of.size());
    std::iota(all_a.begin(), all_a.end(), 0);
    std::iota(all_b.begin(), all_b.end(), 0);
  }
  [[nodiscard]] std::vector<KeypointMatch> match(std::span<const int> of_b) const {
    return match_by_words({*a.features, all_a}, {*b.features, of_b}, {words_a.features, words_b.features},
                          {.max_distance = kStrictDistance, .ratio = 0.85F, .check_rotation = true});
  }

  synthetic::World world;
  synthetic::View a, b;
  ImageWords words_a, words_b;
  std::vector<int> all_a, all_b;
};

TEST_F(WordMatching, FindsMostOfWhatBothSeeAndNothingElse) {
  const std::vector<KeypointMatch> matches = match(all_b);
  EXPECT_GT(matches.size(), 250U);
  for (const KeypointMatch& m : matches) {
    EXPECT_EQ(a.point_of[static_cast<std::size_t>(m.a)], b.point_of[static_cast<std::size_t>(m.b)]);
  }
}

TEST_F(WordMatching, OnlyTheGivenKeypointsTakePart) {
  std::vector<int> even;
  for (std::size_t i = 0; i < all_b.size(); i += 2) even.push_back(static_cast<int>(i));
  const std::vector<KeypointMatch> matches = match(even);
  EXPECT_GT(matches.size(), 100U);
  for (const KeypointMatch& m : matches) EXPECT_EQ(m.b % 2, 0);
  EXPECT_TRUE(match({}).empty());
}

}  // namespace
}  // namespace cpslam
