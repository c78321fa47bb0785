#include "io/trajectory_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(TrajectoryIo, WritesTheTumFormat) {
  const TemporaryFolder folder;
  const std::string path = folder.file("CameraTrajectory.txt");
  write_trajectory(
      path, {{1305031102.175304, {{0.5, -0.5, 0.5, -0.5}, {1.0, -2.25, 0.0000001}}}, {1305031102.2, {}}});
  EXPECT_EQ(TemporaryFolder::content(path),
            "1305031102.175304 1.0000000 -2.2500000 0.0000001 0.5000000 -0.5000000 0.5000000 -0.5000000\n"
            "1305031102.200000 0.0000000 0.0000000 0.0000000 0.0000000 0.0000000 0.0000000 1.0000000\n");
}

TEST(TrajectoryIo, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.txt");
  const Trajectory written = {{1.5, {{0.1, 0.2, 0.3, std::sqrt(1.0 - 0.14)}, {1.0 / 3.0, 2.0 / 3.0, -1e3}}}};
  write_trajectory(path, written);
  const Trajectory read = read_trajectory(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].time_s, 1.5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(read[0].world_from_camera.translation_m[i], written[0].world_from_camera.translation_m[i],
                6e-8);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(read[0].world_from_camera.rotation_xyzw[i], written[0].world_from_camera.rotation_xyzw[i],
                2e-7);
  }
}

TEST(TrajectoryIo, NormalisesQuaternionsAndTakesCommas) {
  const TemporaryFolder folder;
  const Trajectory t = read_trajectory(folder.write("t", "# truth\n1.0,1,2,3,0,0,2,0 # note\n"));
  ASSERT_EQ(t.size(), 1U);
  EXPECT_EQ(t[0].world_from_camera.translation_m, (std::array<double, 3>{1.0, 2.0, 3.0}));
  EXPECT_EQ(t[0].world_from_camera.rotation_xyzw, (std::array<double, 4>{0.0, 0.0, 1.0, 0.0}));
}

TEST(TrajectoryIo, BadFilesNameFileAndLine) {
  const TemporaryFolder folder;
  const auto reading = [&](std::string_view content) {
    return input_error([&] { (void)read_trajectory(folder.write("t.txt", content)); });
  };
  EXPECT_THAT(reading("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n"),
              AllOf(HasSubstr("t.txt:2:"), HasSubstr("found 7 fields")));
  EXPECT_THAT(reading("1 0 0 0 0 0 0 1 9\n"), HasSubstr("t.txt:1:"));
  EXPECT_THAT(reading("\n1 0 0 nan 0 0 0 1\n"), AllOf(HasSubstr("t.txt:2:"), HasSubstr("'nan'")));
  EXPECT_THAT(reading("1 0 0 0 0 0 0 0\n"), AllOf(HasSubstr("t.txt:1:"), HasSubstr("quaternion")));
  EXPECT_THAT(reading("1 0 0 0 1e200 1e300 0 0\n"), HasSubstr("quaternion"));
  EXPECT_THAT(reading(""), HasSubstr("empty"));
  EXPECT_THAT(input_error([&] { (void)read_trajectory(folder.file("none")); }), HasSubstr("No such file"));
}

TEST(TrajectoryIo, UnwritableOutput) {
  const TemporaryFolder folder;
  const std::string path = folder.file("missing/t.txt");
  EXPECT_THAT(error_text<RunError>([&] { write_trajectory(path, {}); }), HasSubstr(path));
}

}  // namespace
}  // namespace cpslam
