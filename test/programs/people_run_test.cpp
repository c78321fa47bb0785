// Runs of rgbd_tum among people.
#include <gmock/gmock.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "io/person_boxes.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

class PeopleRun : public testing::Test {
 protected:
  [[nodiscard]] std::string boxes() const { return crowd_.file("person_boxes.txt"); }
  /// Runs quietly and well.
  void track(const std::vector<std::string>& options) const {
    std::vector<std::string> all{"--quiet"};
    all.insert(all.end(), options.begin(), options.end());
    const ProgramResult result = crowd_.track(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
  }
  [[nodiscard]] std::string trajectory_file() const {
    return TemporaryFolder::content(crowd_.result("CameraTrajectory.txt"));
  }

  const OfficeSequence crowd_{"walking_xyz", 2.0};
};

std::size_t count_boxes(const std::vector<StampedBoxes>& frames) {
  std::size_t n = 0;
  for (const StampedBoxes& frame : frames) n += frame.boxes.size();
  return n;
}

TEST_F(PeopleRun, ReportsWhatTheDetectorAndTheFilterDid) {
  const ProgramResult result = crowd_.track({"--boxes", boxes(), "--seed", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("people      12 detections"));
  EXPECT_THAT(result.out, HasSubstr("detector    "));
  const nlohmann::json stats = crowd_.stats();
  EXPECT_EQ(stats["tracked"], OfficeSequence::kFrames);
  const nlohmann::json settings = stats["settings"];
  EXPECT_EQ(settings["detector"]["kind"], "boxes");
  EXPECT_EQ(settings["detector"]["boxes_file"], boxes());
  EXPECT_EQ(settings["detector"]["policy"], "wait");
  EXPECT_EQ(settings["people"]["filter"], "sdf");
  EXPECT_EQ(settings["people"]["reinstate_still"], true);
  const nlohmann::json people = stats["people"];
  EXPECT_EQ(people["detections"], OfficeSequence::kFrames);
  EXPECT_EQ(people["detector_failures"], 0);
  EXPECT_EQ(people["detections_per_frame"], 1.0);
  // 12 frames span 11 intervals of 1/30 s.
  EXPECT_NEAR(people["detections_per_s"], 12.0 / 11.0 * 30.0, 0.1);
  const std::size_t n_boxes = count_boxes(read_person_boxes(boxes()));
  ASSERT_GT(n_boxes, 0U);
  EXPECT_EQ(people["boxes"], n_boxes);
  EXPECT_NEAR(people["boxes_per_detection"], static_cast<double>(n_boxes) / 12.0, 1e-9);
  EXPECT_EQ(people["boxes_age_s"]["mean"], 0.0);
  EXPECT_EQ(people["boxes_age_s"]["max"], 0.0);
  EXPECT_GT(people["keypoints"], 100U * OfficeSequence::kFrames);
  EXPECT_GT(people["removed_keypoints"], 0);
  EXPECT_NEAR(people["removed_ratio"],
              people["removed_keypoints"].get<double>() / people["keypoints"].get<double>(), 1e-9);
  EXPECT_LT(people["removed_ratio"], 0.9);
  EXPECT_LE(people["detector_ms"]["p50"], people["detector_ms"]["p95"]);
}

TEST_F(PeopleRun, WithoutADetectorThereIsNothingToReport) {
  const ProgramResult result = crowd_.track({"--detector", "none"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::Not(HasSubstr("people")));
  EXPECT_TRUE(crowd_.stats()["people"].is_null());
  EXPECT_EQ(crowd_.stats()["settings"]["detector"]["kind"], "none");
}

TEST_F(PeopleRun, PretendedDetectionsRepeatToTheByte) {
  const std::vector<std::string> options{"--boxes",       boxes(),        "--boxes-policy",
                                         "latest",        "--boxes-rate", "6",
                                         "--boxes-delay", "0.1",          "--sequential"};
  track(options);
  const std::string first = trajectory_file();
  const nlohmann::json stats = crowd_.stats();
  // Of frames 0, 5 and 10; the first arrives with frame 3, the second with frame 8, when that is 8 frames
  // old.
  EXPECT_EQ(stats["people"]["detections"], 3);
  EXPECT_NEAR(stats["people"]["boxes_age_s"]["max"], 7.0 / 30.0, 1e-4);
  EXPECT_EQ(stats["settings"]["detector"]["policy"], "latest");
  EXPECT_EQ(stats["settings"]["detector"]["pretend_rate_hz"], 6.0);
  EXPECT_EQ(stats["settings"]["detector"]["pretend_delay_s"], 0.1);
  track(options);
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(trajectory_file(), first);
}

TEST_F(PeopleRun, FiltersGiveDifferentTrajectories) {
  track({"--boxes", boxes(), "--sequential", "--people-filter", "boxes", "--no-reinstate"});
  EXPECT_EQ(crowd_.stats()["settings"]["people"]["filter"], "boxes");
  EXPECT_EQ(crowd_.stats()["settings"]["people"]["reinstate_still"], false);
  EXPECT_EQ(crowd_.stats()["people"]["reinstated_keypoints"], 0);
  const std::string all_in_boxes = trajectory_file();
  track({"--sequential"});
  EXPECT_NE(trajectory_file(), all_in_boxes);
}

TEST_F(PeopleRun, SavedBoxesAreTheDetectors) {
  const std::string saved = crowd_.folder().file("saved.txt");
  track({"--boxes", boxes(), "--save-boxes", saved, "--sequential"});
  const std::string with_originals = trajectory_file();
  EXPECT_EQ(TemporaryFolder::content(saved), TemporaryFolder::content(boxes()));
  track({"--boxes", saved, "--sequential"});
  EXPECT_EQ(trajectory_file(), with_originals);
}

TEST_F(PeopleRun, BoxesAreSavedWhenStopped) {
  std::vector<std::pair<std::string, std::string>> pairs;
  std::string text;
  for (std::size_t round = 0; round < 100; ++round) {
    const auto more = crowd_.pairs(round % 2 == 1);
    pairs.insert(pairs.end(), more.begin(), more.end());
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    char line[80];
    std::snprintf(line, sizeof line, "%.6f 10 10 20 40 0.900\n", 1000.0 + static_cast<double>(i) / 30.0);
    text += line;
  }
  const std::string all = crowd_.folder().write("all.txt", text);
  const std::string saved = crowd_.folder().file("saved.txt");
  const ProgramResult result =
      crowd_.track({crowd_.associations(pairs), "--boxes", all, "--save-boxes", saved}, {SIGINT, "10 %"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::vector<StampedBoxes> frames = read_person_boxes(saved);
  EXPECT_EQ(frames.size(), crowd_.stats()["people"]["detections"].get<std::size_t>());
  EXPECT_GE(frames.size(), pairs.size() / 10);
  EXPECT_LT(frames.size(), pairs.size());
}

TEST_F(PeopleRun, BoxesThatCannotBeSaved) {
  expect_refused(crowd_.track({"--quiet", "--boxes", boxes(), "--save-boxes", "/no/such/folder/b.txt"}),
                 {"--save-boxes", "/no/such/folder/b.txt"});
  expect_refused(crowd_.track({"--quiet", "--boxes", boxes(), "--save-boxes", crowd_.path()}),
                 {"--save-boxes", crowd_.path()});
  const ProgramResult full = crowd_.track({"--quiet", "--boxes", boxes(), "--save-boxes", "/dev/full"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(lines_of(full.err).size(), 1U) << full.err;
  EXPECT_THAT(full.err, testing::AllOf(HasSubstr("/dev/full"), HasSubstr("No space left")));
  EXPECT_EQ(crowd_.trajectory().size(), OfficeSequence::kFrames);
}

TEST_F(PeopleRun, MissingFilesAreNamedWithTheWayOut) {
  expect_refused(crowd_.track({"--quiet", "--boxes", "no_boxes.txt"}), {"no_boxes.txt", "--detector none"});
  expect_refused(crowd_.track({"--quiet", "--model", "no.cfg", "no.weights"}), {"no.", "--detector none"});
  const std::string cfg = crowd_.folder().write(
      "net.cfg",
      "[net]\nwidth=32\nheight=32\nchannels=3\n[convolutional]\nfilters=18\nsize=1\nstride=1\npad=0\n"
      "activation=linear\n[yolo]\nmask=0,1,2\nanchors=4,8, 8,16, 16,32\nclasses=1\nnum=3\n");
  expect_refused(crowd_.track({"--quiet", "--model", cfg, "no_such.weights"}),
                 {"no_such.weights", "--detector none"});
  EXPECT_FALSE(std::filesystem::exists(crowd_.result("stats.json")));
}

TEST_F(PeopleRun, BadBoxesAreNamedByLine) {
  const std::string bad = crowd_.folder().write("bad.txt", "1.0 1 1 10 10 0.5\n1.1 1 1 wide 10 0.5\n");
  expect_refused(crowd_.track({"--quiet", "--boxes", bad}), {"bad.txt:2: ", "wide"});
}

}  // namespace
}  // namespace cpslam
