#include "diagnosis/image_list.h"

#include <gmock/gmock.h>

#include "diagnosis/findings.h"
#include "io/temporary_folder.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

TEST(ImageLists, WholeOnesAreFine) {
  const TemporaryFolder folder;
  folder.write("a.png", "x");
  folder.write("rgb.txt", "# timestamp filename\n1.0 a.png\n2.0 a.png\n");
  const ImageList list = read_image_list(folder.path(), "rgb.txt");
  EXPECT_EQ(list.stamps, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(worst_level(check_image_list(list)), Level::kOk);
}

TEST(ImageLists, BadLinesAreCountedAndTheOthersKept) {
  const TemporaryFolder folder;
  folder.write("a.png", "x");
  folder.write("rgb.txt", "1.0 a.png\nnonsense\n2.0 a.png b\nnan a.png\n3.0 a.png\n");
  const ImageList list = read_image_list(folder.path(), "rgb.txt");
  EXPECT_EQ(list.stamps, (std::vector<double>{1.0, 3.0}));
  const Finding finding = worst_of(check_image_list(list), "image lists");
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.what, HasSubstr("3 lines"));
  EXPECT_THAT(finding.what, HasSubstr("rgb.txt:2"));
}

TEST(ImageLists, MissingFilesAreToldByShare) {
  const TemporaryFolder folder;
  folder.write("a.png", "x");
  std::string few, many;
  for (int i = 0; i < 100; ++i) {
    few += std::to_string(i) + (i == 50 ? " gone.png\n" : " a.png\n");
    many += std::to_string(i) + (i % 2 == 0 ? " gone.png\n" : " a.png\n");
  }
  folder.write("rgb.txt", few);
  folder.write("depth.txt", many);
  const Finding warning =
      worst_of(check_image_list(read_image_list(folder.path(), "rgb.txt")), "image lists");
  EXPECT_EQ(warning.level, Level::kWarning);
  EXPECT_THAT(warning.what, HasSubstr("1 of 100"));
  EXPECT_THAT(warning.what, HasSubstr("gone.png"));
  EXPECT_EQ(worst_level(check_image_list(read_image_list(folder.path(), "depth.txt"))), Level::kError);
}

TEST(ImageLists, ThatAreMissingOrEmpty) {
  const TemporaryFolder folder;
  folder.write("depth.txt", "# nothing\n");
  EXPECT_EQ(worst_level(check_image_list(read_image_list(folder.path(), "rgb.txt"))), Level::kError);
  EXPECT_EQ(worst_level(check_image_list(read_image_list(folder.path(), "depth.txt"))), Level::kError);
}

}  // namespace
}  // namespace cpslam::diagnosis
