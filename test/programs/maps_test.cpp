// Maps as rgbd_tum saves and loads them.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(MapOptions, SaveLoadLocalise) {
  const OfficeSequence office;
  const std::string map = office.folder().file("office.map");
  const ProgramResult saving = office.track({"--save-map", map});
  ASSERT_EQ(saving.exit_code, 0) << saving.err;
  EXPECT_THAT(saving.out, HasSubstr("map file    " + map));
  EXPECT_TRUE(office.stats()["loaded_map"].is_null());
  const nlohmann::json made = office.stats();
  const Trajectory mapped = office.trajectory();
  const std::string bytes = TemporaryFolder::content(map);

  const ProgramResult localising = office.track({"--load-map", map, "--localization"});
  ASSERT_EQ(localising.exit_code, 0) << localising.err;
  EXPECT_THAT(localising.out, HasSubstr("loaded map"));
  EXPECT_THAT(localising.out, HasSubstr("recognised at"));
  const nlohmann::json stats = office.stats();
  EXPECT_EQ(stats["tracked"], OfficeSequence::kFrames);
  EXPECT_EQ(stats["loaded_map"]["keyframes"], made["keyframes"]);
  EXPECT_EQ(stats["loaded_map"]["points"], made["map_points"]);
  EXPECT_EQ(stats["loaded_map"]["frames_before_found"], 0);
  EXPECT_EQ(stats["keyframes_created"], made["keyframes_created"]);
  EXPECT_EQ(stats["settings"]["load_map"], map);
  EXPECT_EQ(stats["settings"]["localization"], true);
  EXPECT_EQ(TemporaryFolder::content(map), bytes);
  const Trajectory localised = office.trajectory();
  ASSERT_EQ(localised.size(), mapped.size());
  for (std::size_t i = 0; i < mapped.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(localised[i].world_from_camera.translation_m[axis],
                  mapped[i].world_from_camera.translation_m[axis], 0.01);
  }
  EXPECT_EQ(fs::file_size(office.result("KeyFrameTrajectory.txt")), 0U);

  ASSERT_EQ(office.track({"--load-map", map, "--save-map", map, "--quiet"}).exit_code, 0);
  EXPECT_GT(fs::file_size(map), bytes.size()) << "with the frames of this run";
}

TEST(MapOptions, WhatDoesNotGoTogether) {
  const OfficeSequence office;
  expect_refused(office.track({"--localization"}), {"--localization", "--load-map"});
  expect_refused(office.track({"--localization", "--load-map", "a.map", "--save-map", "b.map"}),
                 {"--save-map"});
  expect_refused(office.track({"--load-map", office.folder().file("absent.map")}),
                 {"absent.map", "No such file"});
  expect_refused(office.track({"--load-map", office.settings()}), {"settings.yaml", "no map"});
  expect_refused(office.track({"--save-map", office.folder().file("no/such.map")}),
                 {"--save-map", "no such folder"});
  expect_refused(office.track({"--save-map", office.path()}), {"--save-map", "folder"});
}

TEST(MapOptions, AMapOfAnotherCamera) {
  const OfficeSequence office;
  const std::string map = office.folder().file("office.map");
  ASSERT_EQ(office.track({"--save-map", map, "--quiet"}).exit_code, 0);
  office.change_setting("Camera.fx", "333.0");
  expect_refused(office.track({"--load-map", map}), {map, "another camera", "Camera.fx is", "333"});
}

TEST(MapOptions, InterruptedTheMapIsSaved) {
  const OfficeSequence office;
  std::vector<std::pair<std::string, std::string>> pairs;
  for (int round = 0; round < 100; ++round) {
    const auto more = office.pairs(round % 2 == 1);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  const std::string map = office.folder().file("office.map");
  const ProgramResult result =
      office.track({office.associations(pairs), "--save-map", map}, {SIGINT, "10 %"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("interrupted"));
  const ProgramResult localising = office.track({"--load-map", map, "--localization"});
  EXPECT_EQ(localising.exit_code, 0) << localising.err;
  EXPECT_EQ(office.stats()["tracked"], OfficeSequence::kFrames);
}

TEST(MapOptions, ImagesThatAreMissingCostNoMap) {
  const OfficeSequence office;
  for (const std::size_t frame : {3U, 4U, 11U}) fs::remove(office.file(office.colour(frame)));
  const std::string map = office.folder().file("office.map");
  EXPECT_EQ(office.track({"--save-map", map, "--quiet"}).exit_code, 1);
  EXPECT_EQ(office.track({"--load-map", map, "--localization", "--quiet"}).exit_code, 1) << "for the images";
  EXPECT_EQ(office.stats()["loaded_map"]["frames_before_found"], 0);
}

TEST(MapOptions, AFullDiskKeepsTheOldMapAndIsTold) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const OfficeSequence office;
  const std::string map = office.folder().write("office.map", "of the last run");
  fs::create_symlink("/dev/full", map + ".partial");
  const ProgramResult result = office.track({"--save-map", map, "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("No space left"));
  EXPECT_EQ(TemporaryFolder::content(map), "of the last run");
  EXPECT_EQ(office.trajectory().size(), OfficeSequence::kFrames);
}

TEST(MapOptions, WithoutAMapTheOldOneStays) {
  const OfficeSequence office;
  const std::string map = office.folder().write("office.map", "of the last run");
  office.change_setting("Tracking.minInitialPoints", "100000");
  const ProgramResult result = office.track({"--save-map", map, "--quiet"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("no map to save"));
  EXPECT_EQ(TemporaryFolder::content(map), "of the last run");
}

}  // namespace
}  // namespace cpslam
