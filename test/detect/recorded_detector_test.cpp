#include "detect/recorded_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "detect/recording_detector.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

const cv::Mat kNoImage;

TEST(RecordedDetector, GivesTheBoxesOfTheNearestStampWithinAMillisecond) {
  const TemporaryFolder folder;
  const std::string path = folder.write("boxes.txt",
                                        "1548339827.31623 10 20 30 40 0.9\n"
                                        "1548339827.31623 50 60 70 80 0.5\n"
                                        "1548339827.31763 1 2 3 4 0.7\n"
                                        "1548339826.00000 5 6 7 8 0.6\n");
  RecordedDetector detector(path);
  EXPECT_THAT(detector.name(), testing::HasSubstr("boxes.txt"));
  const auto first_x = [&](double time_s) {
    const std::vector<PersonBox> boxes = detector.detect(kNoImage, time_s);
    return boxes.empty() ? -1.0 : boxes[0].x;
  };
  EXPECT_EQ(detector.detect(kNoImage, 1548339827.31623).size(), 2U);
  EXPECT_EQ(first_x(1548339827.31623), 10.0);
  EXPECT_EQ(first_x(1548339827.31690), 10.0);
  EXPECT_EQ(first_x(1548339827.31697), 1.0);
  EXPECT_EQ(first_x(1548339827.31863), 1.0) << "1 ms";
  EXPECT_EQ(first_x(1548339827.31867), -1.0);
  EXPECT_EQ(first_x(1548339827.31520), -1.0);
  EXPECT_EQ(first_x(1548339825.99900), 5.0);
  EXPECT_EQ(first_x(0.0), -1.0);
  EXPECT_EQ(first_x(1e12), -1.0);
}

TEST(RecordedDetector, WithoutFramesThereIsNobody) {
  RecordedDetector detector({}, "nothing");
  EXPECT_TRUE(detector.detect(kNoImage, 1.0).empty());
}

TEST(RecordedDetector, NamesFileAndLine) {
  const TemporaryFolder folder;
  const std::string path = folder.write("boxes.txt", "1.0 2 3 4 5 0.5\n1.0 2 3 4\n");
  EXPECT_THAT(input_error([&] { RecordedDetector{path}; }), testing::HasSubstr("boxes.txt:2"));
}

/// One box at x = the stamp; throws at stamp 13.
class FakeDetector : public PersonDetector {
 public:
  std::vector<PersonBox> detect(const cv::Mat& /*colour*/, double time_s) override {
    if (time_s == 13.0) throw std::runtime_error("thirteen");
    if (time_s == 0.0) return {};
    return {{time_s, 1.0, 20.0, 30.0, 0.5}};
  }
  [[nodiscard]] std::string name() const override { return "fake"; }
};

TEST(RecordingDetector, PassesThroughAndKeepsInTheOrderOfStamps) {
  RecordingDetector detector(std::make_unique<FakeDetector>());
  EXPECT_EQ(detector.name(), "fake");
  EXPECT_TRUE(detector.recorded().empty());
  EXPECT_EQ(detector.detect(kNoImage, 7.0).size(), 1U);
  EXPECT_EQ(detector.detect(kNoImage, 3.0)[0].x, 3.0);
  EXPECT_TRUE(detector.detect(kNoImage, 0.0).empty());
  EXPECT_EQ(detector.detect(kNoImage, 3.0).size(), 1U) << "twice the same";
  EXPECT_THROW((void)detector.detect(kNoImage, 13.0), std::runtime_error);
  const std::vector<StampedBoxes> recorded = detector.recorded();
  ASSERT_EQ(recorded.size(), 3U);
  EXPECT_EQ(recorded[0].time_s, 0.0);
  EXPECT_TRUE(recorded[0].boxes.empty());
  EXPECT_EQ(recorded[1].time_s, 3.0);
  EXPECT_EQ(recorded[1].boxes.size(), 1U);
  EXPECT_EQ(recorded[2].time_s, 7.0);
}

TEST(RecordingDetector, WhatIsWrittenIsReadAndDetectedAgain) {
  RecordingDetector recording(std::make_unique<FakeDetector>());
  const double start_s = 1548339827.316234;
  for (int i = 0; i < 30; ++i) (void)recording.detect(kNoImage, start_s + i / 30.0);
  const TemporaryFolder folder;
  write_person_boxes(folder.file("boxes.txt"), recording.recorded());
  RecordedDetector recorded(folder.file("boxes.txt"));
  for (int i = 0; i < 30; ++i) {
    const std::vector<PersonBox> boxes = recorded.detect(kNoImage, start_s + i / 30.0);
    ASSERT_EQ(boxes.size(), 1U) << i;
    EXPECT_NEAR(boxes[0].x, start_s + i / 30.0, 0.0051);
  }
}

}  // namespace
}  // namespace cpslam
