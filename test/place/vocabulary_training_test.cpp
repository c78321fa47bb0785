#include "place/vocabulary_training.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "io/error_text.h"
#include "place/small_tree.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

VocabularyTrainingOptions options_of(std::uint32_t branching, std::uint32_t depth) {
  VocabularyTrainingOptions options;
  options.branching = branching;
  options.depth = depth;
  return options;
}

TEST(VocabularyTraining, LooksFarApartBecomeWordsOfTheirOwn) {
  Random random(1);
  const std::vector<ImageDescriptors> images = test::random_images(30, 60, 8, random);
  const Vocabulary vocabulary = train_vocabulary(images, options_of(8, 1));
  ASSERT_EQ(vocabulary.n_words(), 8U);
  std::set<WordId> words;
  for (const Descriptor& descriptor : images.front()) words.insert(vocabulary.word(descriptor));
  for (const Descriptor& a : images.front()) {
    for (const Descriptor& b : images.back())
      EXPECT_EQ(vocabulary.word(a) == vocabulary.word(b), descriptor_distance(a, b) < 60);
  }
}

TEST(VocabularyTraining, WeightsAreInverseDocumentFrequencies) {
  const Descriptor everywhere = test::bits(0);
  const Descriptor somewhere = test::bits(~std::uint64_t{0});
  const std::vector<ImageDescriptors> images{
      {everywhere, somewhere, somewhere}, {everywhere}, {everywhere, everywhere}, {everywhere}};
  const Vocabulary vocabulary = train_vocabulary(images, options_of(2, 1));
  ASSERT_EQ(vocabulary.n_words(), 2U);
  EXPECT_FLOAT_EQ(vocabulary.tree().word_weights[vocabulary.word(everywhere)], 0.0F);
  EXPECT_FLOAT_EQ(vocabulary.tree().word_weights[vocabulary.word(somewhere)], std::log(4.0F));
}

TEST(VocabularyTraining, SameSeedSameVocabulary) {
  Random random(2);
  const std::vector<ImageDescriptors> images = test::random_images(20, 100, 300, random);
  VocabularyTrainingOptions options = options_of(5, 3);
  options.max_features = 1500;
  const std::uint64_t identity = train_vocabulary(images, options).identity();
  EXPECT_EQ(train_vocabulary(images, options).identity(), identity);
  options.seed = 1;
  EXPECT_NE(train_vocabulary(images, options).identity(), identity);
}

TEST(VocabularyTraining, KeepsToBranchesAndLevels) {
  for (const std::uint32_t branching : {2U, 3U, 10U}) {
    for (const std::uint32_t depth : {1U, 2U, 4U}) {
      const Vocabulary vocabulary = test::random_vocabulary(branching, depth, 3);
      EXPECT_LE(static_cast<double>(vocabulary.n_words()), std::pow(branching, depth));
      EXPECT_GT(vocabulary.n_words(), branching - 1);
      EXPECT_EQ(vocabulary.tree().depth, depth);
    }
  }
}

TEST(VocabularyTraining, TheSamePlaceScoresHigherThanAnother) {
  Random random(5);
  const Vocabulary vocabulary =
      train_vocabulary(test::random_images(50, 100, 500, random), options_of(10, 3));
  // 60 of the features of a view come back in the other view of the same place, with other noise.
  const auto view = [&](const std::vector<Descriptor>& looks) {
    ImageDescriptors image;
    for (std::size_t i = 0; i < 100; ++i) {
      image.push_back(i < 60 ? synthetic::flipped(looks[i], 6, static_cast<int>(random.index(250)))
                             : synthetic::random_descriptor(random));
    }
    return vocabulary.transform(image).bow;
  };
  std::vector<BowVector> first;
  std::vector<BowVector> second;
  for (int place = 0; place < 20; ++place) {
    const std::vector<Descriptor> looks = test::random_images(1, 60, 60, random).front();
    first.push_back(view(looks));
    second.push_back(view(looks));
  }
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < second.size(); ++j) {
      if (i == j) continue;
      EXPECT_GT(score(first[i], second[i]), score(first[i], second[j]));
    }
  }
}

TEST(VocabularyTraining, ProgressGrowsToOneAndCanEndIt) {
  Random random(6);
  const std::vector<ImageDescriptors> images = test::random_images(10, 100, 200, random);
  VocabularyTrainingOptions options = options_of(4, 3);
  std::vector<double> shares;
  options.on_progress = [&](double share) {
    shares.push_back(share);
    return true;
  };
  (void)train_vocabulary(images, options);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_NEAR(shares.back(), 1.0, 1e-9);
  options.on_progress = [](double) { return false; };
  EXPECT_THAT(error_text<RunError>([&] { (void)train_vocabulary(images, options); }),
              HasSubstr("interrupted"));
}

TEST(VocabularyTraining, RefusesWhatCannotBeTrained) {
  const std::vector<ImageDescriptors> one{{test::bits(1), test::bits(1)}, {test::bits(1)}};
  const auto error_of = [](const std::vector<ImageDescriptors>& images,
                           const VocabularyTrainingOptions& options) {
    return input_error([&] { (void)train_vocabulary(images, options); });
  };
  EXPECT_THAT(error_of(one, options_of(10, 2)), HasSubstr("are the same"));
  EXPECT_THAT(error_of({}, options_of(10, 2)), HasSubstr("no feature"));
  EXPECT_THAT(error_of({{}, {}}, options_of(10, 2)), HasSubstr("no feature"));
  EXPECT_THAT(error_of(one, options_of(1, 2)), HasSubstr("give 2 to 256"));
  EXPECT_THAT(error_of(one, options_of(300, 2)), HasSubstr("give 2 to 256"));
  EXPECT_THAT(error_of(one, options_of(10, 0)), HasSubstr("give 1 to 16"));
  EXPECT_THAT(error_of(one, options_of(10, 17)), HasSubstr("give 1 to 16"));
}

}  // namespace
}  // namespace cpslam
