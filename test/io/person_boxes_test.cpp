#include "io/person_boxes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(PersonBoxes, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const std::string path = folder.file("person_boxes.txt");
  write_person_boxes(path, {{1.25, {{-3.5, 2.0, 100.25, 200.0, 0.875}, {10.0, 20.0, 30.0, 40.0, 1.0}}},
                            {1.5, {}},
                            {1.75, {{0.0, 0.0, 1.0, 1.0, 0.0}}}});
  const std::vector<StampedBoxes> frames = read_person_boxes(path);
  ASSERT_EQ(frames.size(), 2U) << "a frame without a person has no line";
  EXPECT_EQ(frames[0].time_s, 1.25);
  ASSERT_EQ(frames[0].boxes.size(), 2U);
  EXPECT_EQ(frames[0].boxes[0].x, -3.5);
  EXPECT_EQ(frames[0].boxes[0].y, 2.0);
  EXPECT_EQ(frames[0].boxes[0].width, 100.25);
  EXPECT_EQ(frames[0].boxes[0].height, 200.0);
  EXPECT_EQ(frames[0].boxes[0].confidence, 0.875);
  EXPECT_EQ(frames[0].boxes[1].x, 10.0);
  EXPECT_EQ(frames[1].time_s, 1.75);
  EXPECT_EQ(frames[1].boxes.size(), 1U);
}

TEST(PersonBoxes, NobodyAnywhereIsAFileToo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("person_boxes.txt");
  write_person_boxes(path, {});
  EXPECT_TRUE(read_person_boxes(path).empty());
}

TEST(PersonBoxes, SortsFramesByTime) {
  const TemporaryFolder folder;
  const auto frames = read_person_boxes(folder.write("b", "2 1 1 1 1 1\n1 2 1 1 1 1\n2 3 1 1 1 1\n"));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].time_s, 1.0);
  ASSERT_EQ(frames[1].boxes.size(), 2U);
  EXPECT_EQ(frames[1].boxes[0].x, 1.0);
  EXPECT_EQ(frames[1].boxes[1].x, 3.0);
}

TEST(PersonBoxes, BadLinesNameFileAndLine) {
  const TemporaryFolder folder;
  const auto reading = [&](std::string_view content) {
    return input_error([&] { (void)read_person_boxes(folder.write("boxes.txt", content)); });
  };
  EXPECT_THAT(reading("# h\n1 2 3 4 5\n"), AllOf(HasSubstr("boxes.txt:2:"), HasSubstr("confidence")));
  EXPECT_THAT(reading("1 2 3 4 0 0.5\n"), AllOf(HasSubstr("boxes.txt:1:"), HasSubstr("positive")));
  EXPECT_THAT(reading("1 2 3 -4 5 0.5\n"), HasSubstr("positive"));
  EXPECT_THAT(reading("1 2 3 4 5 1.5\n"), HasSubstr("[0, 1]"));
  EXPECT_THAT(reading("1 2 3 4 5 nan\n"), HasSubstr("'nan'"));
  EXPECT_THAT(input_error([&] { (void)read_person_boxes(folder.file("none")); }), HasSubstr("No such file"));
  EXPECT_THAT(error_text<RunError>([&] { write_person_boxes(folder.file("no/b"), {}); }), HasSubstr("no/b"));
}

}  // namespace
}  // namespace cpslam
