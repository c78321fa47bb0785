// A run that is lost in another place: what it writes about two maps.
#include <gmock/gmock.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "io/trajectory_io.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// The office, and the office as a mirror shows it: a place where the camera has never been.
class SeveralMaps : public testing::Test {
 protected:
  SeveralMaps() {
    fs::create_directories(office_.file("mirrored"));
    pairs_ = office_.pairs();
    for (std::size_t i = 0; i < OfficeSequence::kFrames; ++i)
      pairs_.emplace_back(mirrored(office_.colour(i), "colour", i), mirrored(office_.depth(i), "depth", i));
    office_.change_setting("Tracking.newMapAfter", "0.1");
  }
  [[nodiscard]] std::string mirrored(const std::string& file, const std::string& name, std::size_t i) const {
    const cv::Mat image = cv::imread(office_.file(file), cv::IMREAD_UNCHANGED);
    cv::Mat flipped;
    cv::flip(image, flipped, 1);
    std::string path = "mirrored/" + name + std::to_string(i) + ".png";
    cv::imwrite(office_.file(path), flipped);
    return path;
  }
  [[nodiscard]] ProgramResult run() const {
    return office_.track({"--sequential", office_.associations(pairs_)});
  }

  const OfficeSequence office_;
  std::vector<std::pair<std::string, std::string>> pairs_;
};

TEST_F(SeveralMaps, EachHasFilesOfItsOwn) {
  const ProgramResult result = run();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("maps        2 begun, 0 joined"));
  EXPECT_THAT(result.out, HasSubstr("CameraTrajectory_map2.txt of map 2"));
  const nlohmann::json stats = office_.stats();
  const Trajectory first = office_.trajectory();
  const Trajectory second = read_trajectory(office_.result("CameraTrajectory_map2.txt"));
  EXPECT_EQ(first.size(), OfficeSequence::kFrames);
  EXPECT_GT(second.size(), OfficeSequence::kFrames / 2);
  EXPECT_GT(second.front().time_s, first.back().time_s);
  EXPECT_EQ(stats["tracked"], first.size() + second.size());
  EXPECT_EQ(stats["maps"]["started"], 2);
  EXPECT_EQ(stats["maps"]["joined"], 0);
  EXPECT_EQ(stats["maps"]["at_end"][0]["frames"], first.size());
  EXPECT_EQ(stats["maps"]["at_end"][1]["map"], 2);
  EXPECT_EQ(stats["maps"]["at_end"][1]["frames"], second.size());
  const auto keyframes = [&](const char* file) { return read_trajectory(office_.result(file)).size(); };
  EXPECT_EQ(stats["maps"]["at_end"][0]["keyframes"], keyframes("KeyFrameTrajectory.txt"));
  EXPECT_EQ(stats["maps"]["at_end"][1]["keyframes"], keyframes("KeyFrameTrajectory_map2.txt"));
  EXPECT_EQ(stats["ate"]["pairs"], first.size()) << "of one world";
}

TEST_F(SeveralMaps, TheLargestIsTheMainOne) {
  pairs_.erase(pairs_.begin() + 5, pairs_.begin() + OfficeSequence::kFrames);
  const ProgramResult result = run();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_trajectory(office_.result("CameraTrajectory_map1.txt")).size(), 5U);
  EXPECT_FALSE(fs::exists(office_.result("CameraTrajectory_map2.txt")));
  EXPECT_GT(office_.trajectory().size(), 5U);
  EXPECT_EQ(office_.stats()["maps"]["at_end"][0]["map"], 2);
}

TEST_F(SeveralMaps, FilesOfAnotherRunDoNotStay) {
  ASSERT_EQ(run().exit_code, 0);
  const std::string own = office_.folder().write("results/CameraTrajectory_map_mine.txt", "1 2 3\n");
  pairs_.resize(OfficeSequence::kFrames);
  const ProgramResult result = run();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("maps ")));
  EXPECT_FALSE(fs::exists(office_.result("CameraTrajectory_map2.txt")));
  EXPECT_FALSE(fs::exists(office_.result("KeyFrameTrajectory_map2.txt")));
  EXPECT_TRUE(fs::exists(own));
  EXPECT_EQ(office_.stats()["maps"]["at_end"].size(), 1U);
}

}  // namespace
}  // namespace cpslam
