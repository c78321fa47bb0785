#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string run_error(const std::string& path) {
  return error_text<RunError>([&] { write_file_atomically(path, "new"); });
}

TEST(AtomicFile, WritesAndReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string path = folder.file("stats.json");
  write_file_atomically(path, "old");
  EXPECT_EQ(TemporaryFolder::content(path), "old");
  write_file_atomically(path, std::string_view("n\0w\n", 4));
  EXPECT_EQ(TemporaryFolder::content(path), std::string("n\0w\n", 4));
  write_file_atomically(path, "");
  EXPECT_EQ(TemporaryFolder::content(path), "");
  EXPECT_EQ(folder.file_count(), 1U);
}

TEST(AtomicFile, OntoTheDiskIsTheSameButForTheWait) {
  const TemporaryFolder folder;
  const std::string path = folder.write("room.map", "old");
  write_file_atomically(path, "new", Durability::kOnDisk);
  EXPECT_EQ(TemporaryFolder::content(path), "new");
  EXPECT_EQ(folder.file_count(), 1U);
  std::filesystem::create_symlink("/dev/full", path + ".partial");
  EXPECT_THAT(error_text<RunError>([&] { write_file_atomically(path, "newer", Durability::kOnDisk); }),
              HasSubstr("room.map"));
  EXPECT_EQ(TemporaryFolder::content(path), "new");
}

TEST(AtomicFile, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  EXPECT_THAT(run_error("/dev/full"), AllOf(HasSubstr("/dev/full"), HasSubstr("No space left")));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full")) << "a device is not replaced by a file";
}

TEST(AtomicFile, AFailureKeepsTheOldFile) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const TemporaryFolder folder;
  const std::string path = folder.write("trajectory.txt", "old");
  // The temporary file of this path is on a full disk.
  std::filesystem::create_symlink("/dev/full", path + ".partial");
  EXPECT_THAT(run_error(path), AllOf(HasSubstr(path), HasSubstr("No space left")));
  EXPECT_EQ(TemporaryFolder::content(path), "old");
  EXPECT_EQ(folder.file_count(), 1U) << "the temporary file is gone";
}

TEST(AtomicFile, NamesTheFileAndTheCause) {
  const TemporaryFolder folder;
  EXPECT_THAT(run_error(folder.file("missing/a.txt")),
              AllOf(HasSubstr("missing/a.txt"), HasSubstr("No such file")));
  EXPECT_THAT(run_error(folder.path()), AllOf(HasSubstr(folder.path()), HasSubstr("folder")));
  const std::string file = folder.write("file", "x");
  EXPECT_THAT(run_error(file + "/a.txt"), HasSubstr("Not a directory"));
}

TEST(AtomicFile, ASymbolicLinkStaysOne) {
  const TemporaryFolder folder;
  const std::string target = folder.write("target.txt", "old");
  const std::string link = folder.file("link.txt");
  std::filesystem::create_symlink(target, link);
  write_file_atomically(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(TemporaryFolder::content(target), "new");
}

}  // namespace
}  // namespace cpslam
