#include "place/vocabulary_text.h"

#include <gmock/gmock.h>

#include "io/error_text.h"
#include "place/small_tree.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

/// A node's line with the descriptor's first bytes; the others are 0.
std::string node(int parent, int leaf, const std::string& first_bytes, std::size_t n_first,
                 const std::string& weight) {
  std::string line = std::to_string(parent) + " " + std::to_string(leaf) + " " + first_bytes;
  for (std::size_t i = n_first; i < 32; ++i) line += " 0";
  return line + " " + weight + "\n";
}

const std::string kHeader = "2 2 0 0\n";

/// test::small_tree() in an order that is not breadth first: node 1's children come before node 2.
std::string small_text() {
  return kHeader + node(0, 0, "0", 1, "0") + node(1, 1, "0", 1, "2") + node(1, 1, "255", 1, "5e-1") +
         node(0, 1, "255 255 255 255 255 255 255 255", 8, "1.0");
}

std::string text_error(const std::string& text) {
  return input_error([&] { (void)vocabulary_from_text(text); });
}

TEST(VocabularyText, SameAsTheTreeByHand) {
  const Vocabulary read = vocabulary_from_text(small_text());
  EXPECT_EQ(read.identity(), Vocabulary(test::small_tree()).identity());
}

TEST(VocabularyText, BlanksAndLineEndsDoNotMatter) {
  std::string windows = small_text();
  for (std::size_t i = 0; (i = windows.find('\n', i)) != std::string::npos; i += 3)
    windows.replace(i, 1, " \r\n");
  EXPECT_EQ(vocabulary_from_text(windows).identity(), vocabulary_from_text(small_text()).identity());
  std::string open_end = small_text();
  open_end.pop_back();
  EXPECT_EQ(vocabulary_from_text(open_end).identity(), vocabulary_from_text(small_text()).identity());
}

TEST(VocabularyText, ErrorsNameTheLine) {
  EXPECT_THAT(text_error(" \n\n"), HasSubstr("blank"));
  EXPECT_THAT(text_error("10 6\n"), HasSubstr("line 1: cannot read the kind of scoring"));
  EXPECT_THAT(text_error("2 2 1 0\n"), HasSubstr("line 1: scoring 1 is not supported"));
  EXPECT_THAT(text_error("2 2 0 3\n"), HasSubstr("line 1: weighting 3 is not supported"));
  EXPECT_THAT(text_error("-2 2 0 0\n"), HasSubstr("line 1: cannot read the number of branches"));
  EXPECT_THAT(text_error(kHeader + node(0, 1, "256", 1, "1")), HasSubstr("line 2: cannot read a byte"));
  EXPECT_THAT(text_error(kHeader + node(0, 2, "0", 1, "1")), HasSubstr("line 2: a node is a leaf"));
  EXPECT_THAT(text_error(kHeader + node(0, 1, "0", 1, "")), HasSubstr("line 2: cannot read the weight"));
  EXPECT_THAT(text_error(kHeader + node(0, 1, "0", 0, "1")), HasSubstr("line 2: there is more"));
  EXPECT_THAT(text_error(kHeader), HasSubstr("no leaf and has no children"));
}

TEST(VocabularyText, CyclesAndStrangersAreRefused) {
  EXPECT_THAT(text_error(kHeader + node(1, 1, "0", 1, "1")), HasSubstr("line 2: node 1 has the parent 1"));
  EXPECT_THAT(text_error(kHeader + node(2, 0, "0", 1, "1") + node(1, 0, "0", 1, "1")),
              HasSubstr("line 2: node 1 has the parent 2"));
  EXPECT_THAT(text_error(kHeader + node(0, 1, "0", 1, "1") + node(99, 1, "0", 1, "1")),
              HasSubstr("line 3: node 2 has the parent 99"));
}

TEST(VocabularyText, LeavesMustBeLeaves) {
  EXPECT_THAT(text_error(kHeader + node(0, 0, "0", 1, "1")),
              HasSubstr("node 1 is no leaf and has no children"));
  EXPECT_THAT(text_error(kHeader + node(0, 1, "0", 1, "1") + node(1, 1, "0", 1, "1")),
              HasSubstr("node 1 is a leaf and has children"));
  EXPECT_THAT(
      text_error(kHeader + node(0, 1, "0", 1, "1") + node(0, 1, "0", 1, "1") + node(0, 1, "0", 1, "1")),
      HasSubstr("too many children"));
}

}  // namespace
}  // namespace cpslam
