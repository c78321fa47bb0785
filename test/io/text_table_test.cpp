#include "io/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

TEST(ParseNumber, TakesWholeFiniteNumbersOnly) {
  EXPECT_EQ(parse_number("1305031102.175304"), 1305031102.175304);
  EXPECT_EQ(parse_number("-1.5e-3"), -0.0015);
  EXPECT_EQ(parse_number("+4"), 4.0);
  EXPECT_EQ(parse_number("40."), 40.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* bad :
       {"", "+", "-", "+-1", "1x", "1 ", " 1", "nan", "NaN", "inf", "-inf", "1e999", "0x10", "1,5"}) {
    EXPECT_EQ(parse_number(bad), std::nullopt) << bad;
  }
}

TEST(TextTable, SplitsAtBlanksTabsAndCommasAndSkipsComments) {
  const TemporaryFolder folder;
  TextTable table(folder.write("t", "\xEF\xBB\xBF# head\n\n  1,2\t 3\r\n   \n#x\n4 # tail\n5#6 7"));
  ASSERT_TRUE(table.next_row());
  EXPECT_THAT(table.fields(), ElementsAre("1", "2", "3"));
  EXPECT_EQ(table.number(2), 3.0);
  ASSERT_TRUE(table.next_row());
  EXPECT_THAT(table.fields(), ElementsAre("4"));
  ASSERT_TRUE(table.next_row());
  EXPECT_THAT(table.fields(), ElementsAre("5#6", "7"));
  EXPECT_FALSE(table.next_row());
  EXPECT_FALSE(table.next_row());
}

TEST(TextTable, ErrorsNameFileAndLine) {
  const TemporaryFolder folder;
  const std::string path = folder.write("list.txt", "# head\n1 a\n\n2 b\x01\n");
  TextTable table(path);
  ASSERT_TRUE(table.next_row());
  ASSERT_TRUE(table.next_row());
  EXPECT_EQ(input_error([&] { (void)table.number(1); }), path + ":4: 'b?' is not a finite number");
  EXPECT_EQ(input_error([&] { table.expect_fields(3, "x y z"); }),
            path + ":4: expected 'x y z', found 2 fields");
  EXPECT_EQ(input_error([&] { table.fail_file("is bad"); }), "'" + path + "' is bad");
}

TEST(TextTable, UnreadableFiles) {
  const TemporaryFolder folder;
  const auto opening = [&](const std::string& path) { return input_error([&] { TextTable table(path); }); };
  EXPECT_THAT(opening(folder.file("none")), AllOf(HasSubstr("none"), EndsWith("No such file or directory")));
  EXPECT_THAT(opening(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(opening(folder.write("empty", "")), HasSubstr("is empty"));
}

TEST(Printable, ShortensAndReplacesControlCharacters) {
  EXPECT_EQ(printable("a\nb\x7F"), "a?b?");
  EXPECT_EQ(printable(std::string(100, 'x')), std::string(60, 'x') + "...");
}

}  // namespace
}  // namespace cpslam
