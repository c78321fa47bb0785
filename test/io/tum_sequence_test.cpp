#include "io/tum_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TumSequence : public testing::Test {
 protected:
  std::string associate_error(const std::string& rgb, const std::string& depth) {
    folder_.write("rgb.txt", rgb);
    folder_.write("depth.txt", depth);
    return input_error([&] { (void)associate_sequence(folder_.path()); });
  }
  std::string associations_error(const std::string& content) {
    const std::string path = folder_.write("pairs.txt", content);
    return input_error([&] { (void)read_associations(folder_.path(), path); });
  }
  TemporaryFolder folder_;
};

TEST_F(TumSequence, PairsColourAndDepthOneToOne) {
  folder_.write("rgb.txt",
                "# color images\n# timestamp filename\n1.00 rgb/a.png\n1.03 rgb/b.png\n1.06 rgb/c.png\n");
  folder_.write("depth.txt", "1.01 depth/x.png\n1.025 depth/y.png\n1.1 /absolute/z.png\n");
  const std::vector<RgbdEntry> entries = associate_sequence(folder_.path());
  ASSERT_EQ(entries.size(), 2U) << "1.06 has no depth within 0.02 s";
  EXPECT_EQ(entries[0].time_s, 1.00);
  EXPECT_EQ(entries[0].depth_time_s, 1.01);
  EXPECT_EQ(entries[0].colour_path, folder_.file("rgb/a.png"));
  EXPECT_EQ(entries[0].depth_path, folder_.file("depth/x.png"));
  EXPECT_EQ(entries[1].time_s, 1.03);
  EXPECT_EQ(entries[1].depth_time_s, 1.025);
  const std::vector<RgbdEntry> wider = associate_sequence(folder_.path(), 0.05);
  ASSERT_EQ(wider.size(), 3U);
  EXPECT_EQ(wider[2].depth_path, "/absolute/z.png");
}

TEST_F(TumSequence, MissingFolderAndLists) {
  EXPECT_THAT(input_error([&] { (void)associate_sequence(folder_.file("none")); }),
              AllOf(HasSubstr("none"), HasSubstr("is not a folder")));
  EXPECT_THAT(input_error([&] { (void)associate_sequence(folder_.path()); }),
              AllOf(HasSubstr("rgb.txt"), HasSubstr("No such file")));
  folder_.write("rgb.txt", "1 a\n");
  EXPECT_THAT(input_error([&] { (void)associate_sequence(folder_.path()); }),
              AllOf(HasSubstr("depth.txt"), HasSubstr("No such file")));
}

TEST_F(TumSequence, BadListsNameFileAndLine) {
  const std::string good = "1 d\n";
  EXPECT_THAT(associate_error("", good), AllOf(HasSubstr("rgb.txt"), HasSubstr("empty")));
  EXPECT_THAT(associate_error("# only a comment\n", good),
              AllOf(HasSubstr("rgb.txt"), HasSubstr("lists no image")));
  EXPECT_THAT(associate_error("1 a\n2\n", good),
              AllOf(HasSubstr("rgb.txt:2:"), HasSubstr("timestamp filename")));
  EXPECT_THAT(associate_error("1 a b\n", good), HasSubstr("rgb.txt:1:"));
  EXPECT_THAT(associate_error("nan a\n", good), AllOf(HasSubstr("rgb.txt:1:"), HasSubstr("'nan'")));
  EXPECT_THAT(associate_error("1 a\n1 b\n", good), AllOf(HasSubstr("rgb.txt:2:"), HasSubstr("not later")));
  EXPECT_THAT(associate_error("2 a\n\n1 b\n", good), HasSubstr("rgb.txt:3:"));
  EXPECT_THAT(associate_error("1 a\n", "x d\n"), HasSubstr("depth.txt:1:"));
  EXPECT_THAT(associate_error("1 a\n", "1.5 d\n"), HasSubstr("no stamp of rgb.txt"));
}

TEST_F(TumSequence, ReadsAssociations) {
  const std::string path =
      folder_.write("pairs.txt", "1.0 rgb/a.png 1.5 depth/a.png\n2.0 rgb/b.png 1.5 depth/a.png\n");
  const std::vector<RgbdEntry> entries = read_associations(folder_.path(), path);
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].time_s, 1.0);
  EXPECT_EQ(entries[0].depth_time_s, 1.5);
  EXPECT_EQ(entries[1].colour_path, folder_.file("rgb/b.png"));
  EXPECT_EQ(entries[1].depth_path, folder_.file("depth/a.png"));
}

TEST_F(TumSequence, BadAssociations) {
  EXPECT_THAT(associations_error(""), HasSubstr("empty"));
  EXPECT_THAT(associations_error("#\n"), HasSubstr("lists no pair"));
  EXPECT_THAT(associations_error("1 a 1\n"), AllOf(HasSubstr("pairs.txt:1:"), HasSubstr("found 3 fields")));
  EXPECT_THAT(associations_error("1 a inf d\n"), AllOf(HasSubstr("pairs.txt:1:"), HasSubstr("'inf'")));
  EXPECT_THAT(associations_error("2 a 2 d\n1 a 1 d\n"),
              AllOf(HasSubstr("pairs.txt:2:"), HasSubstr("not later")));
  const std::string elsewhere = folder_.file("none.txt");
  EXPECT_THAT(input_error([&] { (void)read_associations(folder_.path(), elsewhere); }),
              HasSubstr("none.txt"));
  EXPECT_THAT(input_error([&] { (void)read_associations(folder_.file("none"), elsewhere); }),
              HasSubstr("is not a folder"));
}

}  // namespace
}  // namespace cpslam
