// --save-cloud and --save-octomap as users run them.
#include "cpslam/dense_map.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::size_t points_in(const std::string& ply) {
  const std::string before = "element vertex ";
  return std::stoul(ply.substr(ply.find(before) + before.size()));
}

TEST(DenseMapOptions, CloudAndOctomapAreWrittenAndReported) {
  const OfficeSequence office;
  std::vector<std::string> arguments{"--sequential", "--save-cloud", office.folder().file("room.ply")};
  if (DenseMap::can_save_octomap())
    arguments.insert(arguments.end(), {"--save-octomap", office.folder().file("room.bt")});
  const ProgramResult result = office.track(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string ply = TemporaryFolder::content(office.folder().file("room.ply"));
  const std::size_t n = points_in(ply);
  EXPECT_GT(n, 5'000U);
  EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 27 * n);
  const nlohmann::json stats = office.stats()["dense_map"];
  EXPECT_EQ(stats["points"], n);
  EXPECT_EQ(stats["keyframes"], office.stats()["keyframes_created"]);
  EXPECT_THAT(result.out, HasSubstr("dense map   " + std::to_string(n) + " points"));
  EXPECT_THAT(result.out, HasSubstr("room.ply"));
  if (DenseMap::can_save_octomap()) {
    EXPECT_THAT(TemporaryFolder::content(office.folder().file("room.bt")),
                testing::StartsWith("# Octomap OcTree binary file"));
  }
}

TEST(DenseMapOptions, MakeNoDifferenceToTheTrajectory) {
  const OfficeSequence office("walking_xyz");
  const std::vector<std::string> people{"--sequential", "--boxes", office.file("person_boxes.txt")};
  ASSERT_EQ(office.track(people).exit_code, 0);
  const std::string without = TemporaryFolder::content(office.result("CameraTrajectory.txt"));
  EXPECT_FALSE(office.stats().contains("dense_map"));
  std::vector<std::string> with = people;
  with.insert(with.end(), {"--save-cloud", office.folder().file("room.ply")});
  ASSERT_EQ(office.track(with).exit_code, 0);
  EXPECT_EQ(TemporaryFolder::content(office.result("CameraTrajectory.txt")), without);
}

TEST(DenseMapOptions, LargerVoxelsAndLessDepthGiveFewerPoints) {
  const OfficeSequence office;
  const auto points = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--sequential", "--quiet", "--save-cloud",
                                       office.folder().file("a.ply")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(office.track(arguments).exit_code, 0);
    return points_in(TemporaryFolder::content(office.folder().file("a.ply")));
  };
  const std::size_t usual = points({});
  EXPECT_LT(points({"--cloud-voxel", "0.05"}), usual / 3);
  EXPECT_LT(points({"--cloud-max-depth", "2"}), usual);
}

TEST(DenseMapOptions, WhatCannotBeWrittenIsSaidBeforeTheRun) {
  const OfficeSequence office;
  expect_refused(office.track({"--quiet", "--save-cloud", "/no_such_folder/a.ply"}),
                 {"--save-cloud", "/no_such_folder"});
  expect_refused(office.track({"--quiet", "--save-cloud", office.path()}),
                 {"--save-cloud", office.path(), "folder"});
  if (DenseMap::can_save_octomap()) {
    expect_refused(office.track({"--quiet", "--save-octomap", "/no_such_folder/a.bt"}),
                   {"--save-octomap", "/no_such_folder"});
  } else {
    expect_refused(office.track({"--quiet", "--save-octomap", "a.bt"}), {"--save-octomap", "liboctomap-dev"});
  }
  EXPECT_FALSE(fs::exists(office.result("CameraTrajectory.txt")));
}

TEST(DenseMapOptions, BadValuesAreRefused) {
  const OfficeSequence office;
  const std::string ply = office.folder().file("a.ply");
  for (const char* const value : {"0", "-1", "nan", "1e9", "wide"}) {
    expect_refused(office.track({"--save-cloud", ply, "--cloud-voxel", value}), {"--cloud-voxel"});
    expect_refused(office.track({"--save-cloud", ply, "--cloud-max-depth", value}), {"--cloud-max-depth"});
  }
  expect_refused(office.track({"--save-octomap", "a.bt", "--octomap-resolution", "nan"}),
                 {"--octomap-resolution"});
  expect_refused(office.track({"--octomap-resolution", "0.1"}), {"--octomap-resolution", "--save-octomap"});
  for (const char* const option : {"--cloud-voxel", "--cloud-max-depth", "--cloud-memory"})
    expect_refused(office.track({option, option == std::string("--cloud-memory") ? "100" : "0.4"}),
                   {option, "--save-cloud"});
}

TEST(DenseMapOptions, WithoutKeyframesThereIsNone) {
  const OfficeSequence office;
  expect_refused(
      office.track({"--load-map", "a.map", "--localization", "--save-cloud", office.folder().file("a.ply")}),
      {"--save-cloud", "--localization"});
}

TEST(DenseMapOptions, AFullDiskCostsTheCloudAlone) {
  const OfficeSequence office;
  const ProgramResult result = office.track({"--quiet", "--save-cloud", "/dev/full"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("/dev/full"));
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
  EXPECT_GT(office.stats()["dense_map"]["points"], 0);
}

}  // namespace
}  // namespace cpslam
