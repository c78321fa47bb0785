#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cpslam/error.h"
#include "sim/sequence_writer.h"

namespace cpslam::sim {
namespace {

namespace fs = std::filesystem;

class SequenceWriter : public testing::Test {
 protected:
  SequenceWriter() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    directory_ =
        fs::temp_directory_path() / ("cpslam_sim_" + std::to_string(::getpid()) + "_" + info->name());
    fs::remove_all(directory_);
    options_.preset = "walking_static";
    options_.n_frames = 3;
    options_.n_people = 3;
    options_.start_s = 2.0;
  }
  ~SequenceWriter() override { fs::remove_all(directory_); }

  // Lines that are no comments, split at blanks.
  [[nodiscard]] std::vector<std::vector<std::string>> rows(const std::string& name) const {
    std::ifstream file(directory_ / name);
    std::vector<std::vector<std::string>> table;
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      table.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
    }
    return table;
  }

  fs::path directory_;
  SimulationOptions options_;
};

TEST_F(SequenceWriter, FilesHoldWhatWasRendered) {
  Simulation simulation(options_);
  WriteOptions write;
  write.masks = true;
  int calls = 0;
  write.on_progress = [&calls](int done, int total) {
    EXPECT_EQ(done, ++calls);
    EXPECT_EQ(total, 3);
    return true;
  };
  write_sequence(simulation, directory_.string(), write);
  EXPECT_EQ(calls, 3);
  const auto rgb = rows("rgb.txt"), depth = rows("depth.txt"), masks = rows("masks.txt"),
             truth = rows("groundtruth.txt");
  ASSERT_EQ(rgb.size(), 3U);
  ASSERT_EQ(depth.size(), 3U);
  ASSERT_EQ(masks.size(), 3U);
  ASSERT_EQ(truth.size(), 3U);
  std::size_t n_boxes = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const SimulatedFrame frame = simulation.render(static_cast<int>(i));
    n_boxes += frame.people.size();
    EXPECT_NEAR(std::stod(rgb[i][0]), frame.time_s, 1e-6);
    EXPECT_EQ(rgb[i][0], depth[i][0]);
    const cv::Mat colour = cv::imread((directory_ / rgb[i][1]).string(), cv::IMREAD_UNCHANGED);
    const cv::Mat range = cv::imread((directory_ / depth[i][1]).string(), cv::IMREAD_UNCHANGED);
    const cv::Mat mask = cv::imread((directory_ / masks[i][1]).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(range.type(), CV_16UC1);
    EXPECT_EQ(cv::norm(colour, frame.colour_bgr, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(range, frame.depth, cv::NORM_INF), 0.0);
    EXPECT_EQ(cv::norm(mask, frame.person_mask, cv::NORM_INF), 0.0);
    ASSERT_EQ(truth[i].size(), 8U);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(std::stod(truth[i][static_cast<std::size_t>(k) + 1]),
                  frame.world_from_camera.translation[k], 1e-6);
  }
  EXPECT_GT(n_boxes, 0U);
  const auto boxes = rows("person_boxes.txt");
  ASSERT_EQ(boxes.size(), n_boxes);
  EXPECT_EQ(boxes.front().size(), 6U);
  EXPECT_EQ(boxes.front()[0], rgb.front()[0]);
  const Settings settings = load_settings((directory_ / "settings.yaml").string());
  EXPECT_EQ(settings.camera.fx, 535.4);
  EXPECT_EQ(settings.camera.bf, 40.0);
  EXPECT_EQ(settings.camera.depth_map_factor, 5000.0);
}

TEST_F(SequenceWriter, JpegIsSmallAndClose) {
  Simulation simulation(options_);
  WriteOptions write;
  write.jpeg = true;
  write_sequence(simulation, directory_.string(), write);
  const auto rgb = rows("rgb.txt");
  ASSERT_EQ(rgb.size(), 3U);
  EXPECT_EQ(fs::path(rgb[0][1]).extension(), ".jpg");
  const cv::Mat colour = cv::imread((directory_ / rgb[0][1]).string());
  EXPECT_LT(cv::norm(colour, simulation.render(0).colour_bgr, cv::NORM_L1) / (3.0 * 640 * 480), 4.0);
  EXPECT_FALSE(fs::exists(directory_ / "masks"));
}

TEST_F(SequenceWriter, RefusesADirectoryInUseUnlessForced) {
  fs::create_directories(directory_);
  std::ofstream(directory_ / "mine.txt") << "keep";
  options_.n_frames = 1;
  Simulation simulation(options_);
  EXPECT_THROW(write_sequence(simulation, directory_.string(), {}), InputError);
  WriteOptions write;
  write.force = true;
  write_sequence(simulation, directory_.string(), write);
  EXPECT_TRUE(fs::exists(directory_ / "mine.txt"));
  EXPECT_EQ(rows("rgb.txt").size(), 1U);
}

TEST_F(SequenceWriter, AFileInTheWayIsNamed) {
  std::ofstream(directory_) << "a file";
  Simulation simulation(options_);
  EXPECT_THROW(write_sequence(simulation, directory_.string(), {}), InputError);
  try {
    write_sequence(simulation, (directory_ / "below").string(), {});
    FAIL() << "wrote below a file";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(directory_.filename().string()), std::string::npos);
  }
}

TEST_F(SequenceWriter, StopsWhereProgressSaysSo) {
  options_.n_frames = 50;
  Simulation simulation(options_);
  WriteOptions write;
  write.on_progress = [](int done, int) { return done < 2; };
  write_sequence(simulation, directory_.string(), write);
  EXPECT_EQ(rows("rgb.txt").size(), 2U);
  EXPECT_EQ(rows("groundtruth.txt").size(), 2U);
}

}  // namespace
}  // namespace cpslam::sim
