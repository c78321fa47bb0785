#include "place/vocabulary_file.h"

#include <gmock/gmock.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "place/small_tree.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string load_error(const std::string& path) {
  return input_error([&] { (void)load_vocabulary(path); });
}

TEST(VocabularyFile, RoundTrip) {
  const TemporaryFolder folder;
  for (const auto& [branching, depth] : {std::pair{2U, 1U}, {10U, 2U}, {3U, 6U}}) {
    const Vocabulary vocabulary = test::random_vocabulary(branching, depth, 1);
    save_vocabulary(folder.file("a.voc"), vocabulary);
    const Vocabulary read = load_vocabulary(folder.file("a.voc"));
    EXPECT_EQ(read.identity(), vocabulary.identity());
    EXPECT_EQ(read.tree().first_child, vocabulary.tree().first_child);
    EXPECT_EQ(read.tree().word_weights, vocabulary.tree().word_weights);
    EXPECT_EQ(to_bytes(read), to_bytes(vocabulary));
  }
  EXPECT_EQ(folder.file_count(), 1U) << "nothing is left beside it";
}

TEST(VocabularyFile, LayoutByHand) {
  const std::string bytes = to_bytes(Vocabulary(test::small_tree()));
  EXPECT_EQ(bytes.size(), 40U + 4U * 32U + 6U * 4U + 3U * 4U);
  const std::string start("CPS-VOC\n\1\0\0\0\2\0\0\0\2\0\0\0\5\0\0\0\3\0\0\0\0\0\0\0", 32);
  EXPECT_EQ(bytes.substr(0, 32), start);
  EXPECT_EQ(bytes.substr(40, 32), std::string(32, '\0')) << "node 1";
  EXPECT_EQ(bytes.substr(72, 32), std::string(8, '\xFF') + std::string(24, '\0')) << "node 2";
  EXPECT_EQ(bytes.substr(40 + 4 * 32, 8), std::string("\1\0\0\0\3\0\0\0", 8)) << "children of 0 and 1 begin";
  EXPECT_EQ(bytes.substr(bytes.size() - 12, 4), std::string("\0\0\x80\x3F", 4)) << "the weight 1";
}

TEST(VocabularyFile, WhatIsNoFileOfOurs) {
  const TemporaryFolder folder;
  EXPECT_THAT(load_error(folder.file("absent.voc")),
              AllOf(HasSubstr("absent.voc"), HasSubstr("No such file")));
  EXPECT_THAT(load_error(folder.path()), HasSubstr("no regular file"));
  EXPECT_THAT(load_error("/dev/zero"), HasSubstr("no regular file"));
  EXPECT_THAT(load_error(folder.write("empty.voc", "")), HasSubstr("empty.voc' is empty"));
  EXPECT_THAT(load_error(folder.write("picture.png", "\x89PNG\r\n")),
              HasSubstr("picture.png': this is no ORB"));
}

TEST(VocabularyFile, CutShortOrTooLong) {
  const TemporaryFolder folder;
  const std::string bytes = to_bytes(Vocabulary(test::small_tree()));
  for (std::size_t n = 8; n < bytes.size(); ++n) {
    EXPECT_THAT(load_error(folder.write("a.voc", std::string_view(bytes).substr(0, n))),
                AllOf(HasSubstr("a.voc'"), HasSubstr("cut short")));
  }
  EXPECT_THAT(load_error(folder.write("a.voc", bytes + "x")), HasSubstr("too long"));
}

TEST(VocabularyFile, AnotherVersion) {
  const TemporaryFolder folder;
  std::string bytes = to_bytes(Vocabulary(test::small_tree()));
  bytes[8] = 2;
  EXPECT_THAT(load_error(folder.write("a.voc", bytes)),
              AllOf(HasSubstr("version 2"), HasSubstr("reads version 1"), HasSubstr("make it again")));
}

TEST(VocabularyFile, HugePromisesAreRefusedBeforeAnythingIsAllocated) {
  const TemporaryFolder folder;
  std::string bytes = to_bytes(Vocabulary(test::small_tree()));
  for (const std::size_t field : {20U, 24U}) {
    std::string huge = bytes;
    huge.replace(field, 4, 4, '\xFF');
    EXPECT_THAT(load_error(folder.write("a.voc", huge)), HasSubstr("cut short"));
    huge.replace(field, 4, 4, '\0');
    EXPECT_FALSE(load_error(folder.write("a.voc", huge)).empty());
  }
}

TEST(VocabularyFile, EveryDamagedByteIsNoticed) {
  const std::string bytes = to_bytes(Vocabulary(test::small_tree()));
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    EXPECT_THROW((void)vocabulary_from_bytes(damaged), InputError) << "byte " << i;
  }
}

}  // namespace
}  // namespace cpslam
