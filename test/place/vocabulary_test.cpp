#include "place/vocabulary.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

#include "io/error_text.h"
#include "place/small_tree.h"

namespace cpslam {
namespace {

using test::bits;
using test::small_tree;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Vocabulary, WordsByHand) {
  const Vocabulary vocabulary(small_tree());
  EXPECT_EQ(vocabulary.n_nodes(), 5U);
  EXPECT_EQ(vocabulary.n_words(), 3U);
  EXPECT_EQ(vocabulary.word(bits(~std::uint64_t{0} << 8U)), 0U);
  EXPECT_EQ(vocabulary.word(bits(1)), 1U);
  EXPECT_EQ(vocabulary.word(bits(0x3F)), 2U);
  EXPECT_EQ(vocabulary.word(bits(0x0F)), 1U) << "equally near: the first";
}

TEST(Vocabulary, BagAndIndexByHand) {
  const Vocabulary vocabulary(small_tree());
  const std::vector<Descriptor> image{bits(0), bits(0xFF), bits(~std::uint64_t{0}), bits(1)};
  const ImageWords words = vocabulary.transform(image, 1);
  // Word 0 once by 1, word 1 twice by 2, word 2 once by 0.5: 5.5 in all.
  ASSERT_EQ(words.bow.size(), 3U);
  EXPECT_EQ(words.bow[0].word, 0U);
  EXPECT_FLOAT_EQ(words.bow[0].weight, 1.0F / 5.5F);
  EXPECT_EQ(words.bow[1].word, 1U);
  EXPECT_FLOAT_EQ(words.bow[1].weight, 4.0F / 5.5F);
  EXPECT_EQ(words.bow[2].word, 2U);
  EXPECT_FLOAT_EQ(words.bow[2].weight, 0.5F / 5.5F);
  ASSERT_EQ(words.features.size(), 2U);
  EXPECT_EQ(words.features.entry(0).node, 1U);
  EXPECT_THAT(words.features.entry(0).features, ElementsAre(0, 1, 3));
  EXPECT_EQ(words.features.entry(1).node, 2U);
  EXPECT_THAT(words.features.entry(1).features, ElementsAre(2));
}

TEST(Vocabulary, IndexDepthChoosesTheNodes) {
  const Vocabulary vocabulary(small_tree());
  const std::vector<Descriptor> image{bits(0), bits(0xFF), bits(~std::uint64_t{0})};
  EXPECT_EQ(vocabulary.transform(image, 0).features.entry(0).node, 0U);
  EXPECT_EQ(vocabulary.transform(image, 0).features.size(), 1U);
  for (const std::uint32_t depth : {2U, 9U}) {
    const ImageWords words = vocabulary.transform(image, depth);
    ASSERT_EQ(words.features.size(), 3U);
    EXPECT_EQ(words.features.entry(0).node, 2U) << "a leaf at depth 1 stands for itself";
    EXPECT_EQ(words.features.entry(1).node, 3U);
    EXPECT_EQ(words.features.entry(2).node, 4U);
  }
}

TEST(Vocabulary, WordsThatSayNothingAreLeftOutOfTheBag) {
  VocabularyTree tree = small_tree();
  tree.word_weights[1] = 0.0F;
  const Vocabulary vocabulary(tree);
  const ImageWords words = vocabulary.transform(std::vector<Descriptor>{bits(0), bits(0xFF)});
  ASSERT_EQ(words.bow.size(), 1U);
  EXPECT_EQ(words.bow[0].word, 2U);
  EXPECT_FLOAT_EQ(words.bow[0].weight, 1.0F);
  EXPECT_EQ(words.features.size(), 2U);
  EXPECT_TRUE(vocabulary.transform(std::vector<Descriptor>{bits(0)}).bow.empty());
  EXPECT_TRUE(vocabulary.transform({}).bow.empty());
}

TEST(Vocabulary, BagsOfRandomImagesSumToOne) {
  const Vocabulary vocabulary = test::random_vocabulary(4, 3, 7);
  Random random(8);
  for (const ImageDescriptors& image : test::random_images(20, 200, 100, random)) {
    const ImageWords words = vocabulary.transform(image);
    double sum = 0.0;
    for (std::size_t i = 0; i < words.bow.size(); ++i) {
      sum += static_cast<double>(words.bow[i].weight);
      if (i > 0) {
        EXPECT_LT(words.bow[i - 1].word, words.bow[i].word);
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
    EXPECT_NEAR(score(words.bow, words.bow), 1.0, 1e-5);
    std::size_t n = 0;
    for (std::size_t i = 0; i < words.features.size(); ++i) n += words.features.entry(i).features.size();
    EXPECT_EQ(n, image.size());
  }
}

TEST(Vocabulary, IdentityFollowsTheContent) {
  const std::uint64_t identity = Vocabulary(small_tree()).identity();
  EXPECT_EQ(Vocabulary(small_tree()).identity(), identity);
  VocabularyTree other = small_tree();
  other.descriptors[4] = bits(0xFE);
  EXPECT_NE(Vocabulary(other).identity(), identity);
  other = small_tree();
  other.word_weights[2] = 0.25F;
  EXPECT_NE(Vocabulary(other).identity(), identity);
  other = small_tree();
  other.depth = 3;
  EXPECT_NE(Vocabulary(other).identity(), identity);
}

TEST(Vocabulary, RefusesWhatIsNoTree) {
  const auto error_of = [](const auto& spoil) {
    VocabularyTree tree = small_tree();
    spoil(tree);
    return input_error([&] { (void)Vocabulary(tree); });
  };
  using Tree = VocabularyTree;
  EXPECT_THAT(error_of([](Tree& t) { t.branching = 1; }), HasSubstr("1 branches"));
  EXPECT_THAT(error_of([](Tree& t) { t.branching = 257; }), HasSubstr("257 branches"));
  EXPECT_THAT(error_of([](Tree& t) { t.depth = 0; }), HasSubstr("0 levels"));
  EXPECT_THAT(error_of([](Tree& t) { t.depth = 17; }), HasSubstr("17 levels"));
  EXPECT_THAT(error_of([](Tree& t) { t.depth = 1; }), HasSubstr("deeper than the 1 levels"));
  EXPECT_THAT(error_of([](Tree& t) { t.descriptors.pop_back(); }), HasSubstr("differ in number"));
  EXPECT_THAT(error_of([](Tree& t) { t = {2, 1, {bits(0)}, {1, 1}, {1.0F}}; }), HasSubstr("1 nodes"));
  EXPECT_THAT(error_of([](Tree& t) { t.first_child[0] = 0; }), HasSubstr("nobody's children"));
  EXPECT_THAT(error_of([](Tree& t) { t.first_child[5] = 4; }), HasSubstr("nobody's children"));
  EXPECT_THAT(error_of([](Tree& t) { t.first_child[1] = 1; }), HasSubstr("out of order")) << "its own parent";
  EXPECT_THAT(error_of([](Tree& t) { t.first_child[2] = 2; }), HasSubstr("out of order"));
  EXPECT_THAT(error_of([](Tree& t) { t.first_child[2] = 0xFFFFFFFF; }), HasSubstr("too many children"));
  EXPECT_THAT(error_of([](Tree& t) { t.first_child = {1, 4, 5, 5, 5, 5}; }), HasSubstr("too many children"));
  EXPECT_THAT(error_of([](Tree& t) { t.word_weights.pop_back(); }), HasSubstr("3 words, but weights for 2"));
  EXPECT_THAT(error_of([](Tree& t) { t.word_weights[0] = -1.0F; }), HasSubstr("negative"));
  EXPECT_THAT(error_of([](Tree& t) { t.word_weights[1] = std::numeric_limits<float>::quiet_NaN(); }),
              HasSubstr("no number"));
}

}  // namespace
}  // namespace cpslam
