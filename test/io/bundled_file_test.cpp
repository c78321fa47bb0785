#include "io/bundled_file.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::HasSubstr;
using testing::Optional;

TEST(BundledFile, TheFirstFolderThatHasAllFilesCounts) {
  const TemporaryFolder folder;
  folder.write("half/models/a.cfg", "x");
  folder.write("whole/models/a.cfg", "x");
  folder.write("whole/models/a.weights", "x");
  folder.write("later/models/a.cfg", "x");
  folder.write("later/models/a.weights", "x");
  const std::vector<std::string> folders{folder.file("absent"), folder.file("half"), folder.file("whole"),
                                         folder.file("later")};
  EXPECT_THAT(find_data_folder(folders, {"models/a.cfg"}), Optional(folder.file("half")));
  EXPECT_THAT(find_data_folder(folders, {"models/a.cfg", "models/a.weights"}),
              Optional(folder.file("whole")));
  EXPECT_EQ(find_data_folder(folders, {"models/b.cfg"}), std::nullopt);
  EXPECT_EQ(find_data_folder(folders, {"models"}), std::nullopt) << "a folder is no file";
  EXPECT_EQ(find_data_folder({}, {"models/a.cfg"}), std::nullopt);
}

TEST(BundledFile, TheEnvironmentComesAfterExecutableAndInstallation) {
  const TemporaryFolder folder;
  const std::string file = "a_test_of_bundled_files.txt";
  const std::string path = folder.write(file, "x");
  ASSERT_EQ(unsetenv("CPSLAM_DATA"), 0);
  const std::vector<std::string> without = data_folders();
  EXPECT_EQ(find_bundled_file(file), std::nullopt);
  EXPECT_THAT(not_bundled_text(file), HasSubstr("'" + file + "' is not in '" + without.front() + "'"));

  ASSERT_EQ(setenv("CPSLAM_DATA", folder.path().c_str(), 1), 0);
  std::vector<std::string> with = data_folders();
  EXPECT_THAT(find_bundled_file(file), Optional(path));
  EXPECT_THAT(not_bundled_text(file), testing::EndsWith(" or '" + folder.path() + "'"));
  ASSERT_EQ(unsetenv("CPSLAM_DATA"), 0);

  ASSERT_FALSE(with.empty());
  EXPECT_EQ(with.back(), folder.path());
  with.pop_back();
  EXPECT_EQ(with, without);
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(with.front(), executable.parent_path().string());
  EXPECT_THAT(with.at(1), testing::EndsWith("/cpslam"));
}

}  // namespace
}  // namespace cpslam
