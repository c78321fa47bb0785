#include <gtest/gtest.h>

#include <filesystem>

#include "io/image_reader.h"
#include "io/person_boxes.h"
#include "io/trajectory_error.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"
#include "support/shared_data.h"

namespace cpslam {
namespace {

/// A real clip's folder, or nothing where the data is not at hand.
std::string clip(const std::string& name) {
  const std::filesystem::path folder = shared_data_dir() / name;
  return std::filesystem::is_directory(folder) ? folder.string() : "";
}

TEST(RealClips, DeskIsReadWhole) {
  const std::string folder = clip("fr1_desk_dev");
  if (folder.empty()) GTEST_SKIP() << "no clip fr1_desk_dev in CPSLAM_SHARED_DATA";
  const std::vector<RgbdEntry> entries = associate_sequence(folder);
  ASSERT_EQ(entries.size(), 250U);
  for (std::size_t i = 0; i < entries.size(); i += 50) {
    const RgbdImages images = read_rgbd(entries[i]);
    EXPECT_EQ(images.error, "");
    EXPECT_EQ(images.colour.size(), cv::Size(640, 480));
    EXPECT_EQ(images.depth.type(), CV_16UC1);
  }
  const Trajectory truth = read_trajectory(folder + "/groundtruth.txt");
  const TrajectoryError error = absolute_trajectory_error(truth, truth);
  EXPECT_EQ(error.pairs, truth.size());
  EXPECT_LT(error.max_m, 1e-12);
}

TEST(RealClips, CrowdHasItsBoxes) {
  const std::string folder = clip("bonn_crowd_dev");
  if (folder.empty()) GTEST_SKIP() << "no clip bonn_crowd_dev in CPSLAM_SHARED_DATA";
  const std::vector<RgbdEntry> entries = associate_sequence(folder);
  EXPECT_EQ(entries.size(), 380U);
  const std::vector<StampedBoxes> frames = read_person_boxes(folder + "/person_boxes.txt");
  ASSERT_FALSE(frames.empty());
  std::size_t found = 0;
  for (const StampedBoxes& frame : frames) {
    for (const RgbdEntry& entry : entries) found += entry.time_s == frame.time_s ? 1U : 0U;
  }
  EXPECT_EQ(found, frames.size()) << "boxes carry the stamps of colour images";
}

}  // namespace
}  // namespace cpslam
