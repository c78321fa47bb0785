#include "io/sequence_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <mutex>

#include "cpslam/error.h"
#include "io/error_text.h"
#include "io/image_reader.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"
#include "io/tum_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

Settings settings() {
  Settings settings;
  settings.camera.width = 64;
  settings.camera.height = 64;
  settings.camera.fx = settings.camera.fy = 60.0;
  settings.camera.cx = settings.camera.cy = 31.5;
  settings.camera.depth_map_factor = 1000.0;
  return settings;
}

RgbdFrame frame(std::uint64_t i) {
  RgbdFrame frame;
  frame.colour = noise_image({64, 64}, CV_8UC3, i + 1);
  frame.depth = noise_image({64, 64}, CV_16UC1, i + 1001);
  frame.time_s = 10.0 + static_cast<double>(i) / 30.0;
  frame.depth_time_s = frame.time_s + 0.004;
  return frame;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(SequenceRecorder, WhatIsReadBackIsWhatWasRecorded) {
  const TemporaryFolder folder;
  const std::string session = folder.file("a/session");
  SequenceRecorder recorder(session, settings(), WhenBusy::kWait, {});
  for (std::uint64_t i = 0; i < 100; ++i) recorder.add(frame(i));
  recorder.finish();
  EXPECT_EQ(recorder.recorded(), 100U);
  EXPECT_EQ(recorder.dropped(), 0U);
  EXPECT_TRUE(recorder.complete());
  EXPECT_EQ(to_yaml(load_settings(session + "/settings.yaml")), to_yaml(settings()));
  const std::vector<RgbdEntry> entries = associate_sequence(session);
  ASSERT_EQ(entries.size(), 100U);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const RgbdFrame expected = frame(i);
    const RgbdImages images = read_rgbd(entries[i]);
    ASSERT_EQ(images.error, "");
    EXPECT_NEAR(images.time_s, expected.time_s, 1e-6);
    EXPECT_NEAR(images.depth_time_s, *expected.depth_time_s, 1e-6);
    EXPECT_TRUE(same(images.colour, expected.colour)) << i;
    EXPECT_TRUE(same(images.depth, expected.depth)) << i;
  }
}

TEST(SequenceRecorder, WhatIsNotDroppedIsThere) {
  const TemporaryFolder folder;
  SequenceRecorder recorder(folder.file("session"), settings(), WhenBusy::kLeaveOut, {});
  for (std::uint64_t i = 0; i < 500; ++i) recorder.add(frame(i));
  recorder.finish();
  EXPECT_EQ(recorder.recorded() + recorder.dropped(), 500U);
  EXPECT_EQ(associate_sequence(recorder.folder()).size(), recorder.recorded());
}

TEST(SequenceRecorder, AnUnfinishedRecordingCanBeRead) {
  const TemporaryFolder folder;
  SequenceRecorder recorder(folder.file("session"), settings(), WhenBusy::kWait, {});
  // The queue has room for 32: the first ones are on disk when the last has found a place.
  for (std::uint64_t i = 0; i < 50; ++i) recorder.add(frame(i));
  const std::vector<RgbdEntry> entries = associate_sequence(recorder.folder());
  EXPECT_GE(entries.size(), 16U);
  for (const RgbdEntry& entry : entries) EXPECT_EQ(read_rgbd(entry).error, "");
}

TEST(SequenceRecorder, AFrameThatCannotBeWrittenEndsTheRecordingAlone) {
  const TemporaryFolder folder;
  std::mutex mutex;
  std::vector<std::string> messages;
  const LogSink log = [&](LogLevel level, const std::string& message) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(level, LogLevel::kWarning);
    messages.push_back(message);
  };
  SequenceRecorder recorder(folder.file("session"), settings(), WhenBusy::kWait, log);
  recorder.add(frame(0));
  for (std::uint64_t i = 1; recorder.recorded() == 0; ++i) recorder.add(frame(i));
  fs::remove_all(folder.file("session/depth"));
  for (std::uint64_t i = 1000; i < 2000; ++i) recorder.add(frame(i));
  recorder.finish();
  EXPECT_FALSE(recorder.complete());
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_THAT(messages[0], AllOf(HasSubstr("session/depth/"), HasSubstr("recording ends")));
}

TEST(SequenceRecorder, RefusesFoldersThatAreInUse) {
  const TemporaryFolder folder;
  folder.write("used/notes.txt", "mine");
  folder.write("file", "mine");
  for (const std::string& name : {folder.file("used"), folder.file("file"), std::string("/proc/none/here")}) {
    const std::string error = input_error([&] { SequenceRecorder(name, settings(), WhenBusy::kWait, {}); });
    EXPECT_THAT(error, HasSubstr(name));
  }
  EXPECT_EQ(TemporaryFolder::content(folder.file("used/notes.txt")), "mine");
}

}  // namespace
}  // namespace cpslam
