// All checks together, on the simulator's sequences.
#include "diagnosis/examination.h"

#include <gmock/gmock.h>

#include "diagnosis/findings.h"
#include "sim/simulation.h"
#include "support/half_size.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kFrames = 60;

/// A simulated walk with sensor noise; depth is taken depth_later_s after its stamp.
Findings examine(const std::string& preset, double depth_later_s = 0.0) {
  sim::SimulationOptions options;
  options.preset = preset;
  options.sensor_noise = true;
  options.n_frames = kFrames;
  options.start_s = 3.0;
  test::halve(options.camera);
  sim::Simulation colour(options);
  options.start_s += depth_later_s;
  sim::Simulation depth(options);
  Examination examination(colour.camera());
  for (int i = 0; i < kFrames; ++i) {
    RgbdImages images;
    const sim::SimulatedFrame frame = colour.render(i);
    images.time_s = images.depth_time_s = frame.time_s;
    images.colour = frame.colour_bgr;
    images.depth = depth_later_s == 0.0 ? frame.depth : depth.render(i).depth;
    examination.add(images);
  }
  EXPECT_EQ(examination.n_frames(), static_cast<std::size_t>(kFrames));
  return examination.findings();
}

TEST(Examination, HealthySequencesGetNoWarning) {
  for (const char* const preset : {"office_rpy", "walking_xyz"}) {
    const Findings findings = examine(preset);
    EXPECT_LE(worst_level(findings), Level::kNote) << preset << "\n" << texts_above(findings, Level::kNote);
    EXPECT_NEAR(value_of(findings, "registration", "right_px"), 0.0, 0.5) << preset;
    EXPECT_NEAR(value_of(findings, "time offset", "delay_s"), 0.0, 0.005) << preset;
  }
}

TEST(Examination, DelayOfASimulatedCamera) {
  for (const double later_s : {0.03, -0.05}) {
    const Findings findings = examine("office_rpy", later_s);
    EXPECT_NEAR(value_of(findings, "time offset", "delay_s"), -later_s, 0.005);
    EXPECT_EQ(worst_of(findings, "registration").level, Level::kOk);
  }
}

RgbdImages grey_pair(cv::Size size) {
  RgbdImages images;
  images.colour = cv::Mat(size, CV_8UC3, cv::Scalar::all(100));
  images.depth = cv::Mat(size, CV_16UC1, cv::Scalar(10000));
  return images;
}

TEST(Examination, UnusablePairsAreCountedAndTheFirstIsNamed) {
  Examination examination(std::nullopt);
  for (int i = 0; i < 50; ++i) {
    RgbdImages images = grey_pair({64, 48});
    if (i == 20 || i == 30) images.error = format_text("'%d.png' is truncated", i);
    examination.add(images);
  }
  const Finding finding = worst_of(examination.findings(), "images");
  EXPECT_EQ(finding.level, Level::kWarning);
  EXPECT_THAT(finding.what, HasSubstr("2 cannot be used, the first: '20.png' is truncated"));
}

TEST(Examination, SizesThatChangeAreAnError) {
  Examination examination(std::nullopt);
  for (int i = 0; i < 20; ++i) examination.add(grey_pair(i < 10 ? cv::Size(64, 48) : cv::Size(32, 24)));
  const Finding finding = worst_of(examination.findings(), "images");
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.what, HasSubstr("32x24"));
}

TEST(Examination, OddSizesDoNoHarm) {
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(3, 200), cv::Size(200, 2), cv::Size(33, 32), cv::Size(1000, 32)}) {
    const bool is_large_enough = std::min(size.width, size.height) >= 32;
    Examination examination(std::nullopt);
    for (int i = 0; i < 30; ++i) {
      RgbdImages images = grey_pair(size);
      images.time_s = images.depth_time_s = i / 30.0;
      examination.add(images);
    }
    EXPECT_EQ(worst_of(examination.findings(), "images").level, is_large_enough ? Level::kOk : Level::kError);
  }
}

TEST(ChooseFrames, AllWhenThereAreFew) {
  EXPECT_THAT(choose_frames(4, 10), ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(choose_frames(0, 10).empty());
}

TEST(ChooseFrames, StretchesSpreadFromTheFirstToTheLast) {
  for (const std::size_t wanted : {1U, 74U, 150U, 300U, 1000U}) {
    const std::vector<std::size_t> chosen = choose_frames(5000, wanted);
    ASSERT_EQ(chosen.size(), wanted);
    EXPECT_EQ(chosen.front(), 0U);
    std::size_t n_jumps = 0;
    for (std::size_t i = 1; i < chosen.size(); ++i) {
      ASSERT_GT(chosen[i], chosen[i - 1]);
      if (chosen[i] != chosen[i - 1] + 1) ++n_jumps;
    }
    EXPECT_EQ(n_jumps, wanted < 150 ? 0U : wanted / 75 - 1);
    if (wanted >= 150) {
      EXPECT_EQ(chosen.back(), 4999U);
    }
  }
}

}  // namespace
}  // namespace cpslam::diagnosis
