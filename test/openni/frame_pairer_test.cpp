#include "openni/frame_pairer.h"

#include <gtest/gtest.h>

#include <vector>

#include "openni/camera_frames.h"
#include "util/random.h"

namespace cpslam {
namespace {

using test::picture;

constexpr double kTolerance_s = 0.05;

TEST(FramePairer, ToleratesNoMoreThanAssociateDoes) {
  EXPECT_DOUBLE_EQ(pair_tolerance_s(30.0), 1.0 / 60.0);
  EXPECT_DOUBLE_EQ(pair_tolerance_s(15.0), 0.02);
}

TEST(FramePairer, EitherMayComeFirst) {
  FramePairer pairer(kTolerance_s);
  EXPECT_FALSE(pairer.add_colour(picture(100'000)));
  const auto first = pairer.add_depth(picture(120'000));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->colour.time_us, 100'000U);
  EXPECT_EQ(first->depth.time_us, 120'000U);
  EXPECT_FALSE(pairer.add_depth(picture(220'000)));
  const auto second = pairer.add_colour(picture(200'000));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->depth.time_us, 220'000U);
  EXPECT_EQ(pairer.unpaired(), 0U);
}

TEST(FramePairer, TheToleranceIsTooFar) {
  FramePairer pairer(kTolerance_s);
  EXPECT_FALSE(pairer.add_colour(picture(100'000)));
  EXPECT_FALSE(pairer.add_depth(picture(150'000)));
  EXPECT_TRUE(pairer.add_colour(picture(199'999)));
  EXPECT_EQ(pairer.unpaired(), 1U);
}

TEST(FramePairer, TheNearestOfThoseThatWaitIsTaken) {
  FramePairer pairer(kTolerance_s);
  for (const std::uint64_t us : {100'000U, 200'000U, 300'000U}) EXPECT_FALSE(pairer.add_colour(picture(us)));
  const auto frame = pairer.add_depth(picture(210'000));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->colour.time_us, 200'000U);
  EXPECT_EQ(pairer.unpaired(), 1U) << "the one before has missed its chance";
  const auto next = pairer.add_depth(picture(310'000));
  ASSERT_TRUE(next);
  EXPECT_EQ(next->colour.time_us, 300'000U);
}

TEST(FramePairer, AStreamThatIsGoneCostsNoMemory) {
  FramePairer pairer(kTolerance_s);
  for (std::uint64_t i = 0; i < 1000; ++i) EXPECT_FALSE(pairer.add_colour(picture(i * 100'000)));
  EXPECT_EQ(pairer.unpaired(), 996U);
}

TEST(FramePairer, GoesOnAfterTheClockJumped) {
  for (const std::uint64_t after : {std::uint64_t{1'000}, std::uint64_t{900'000'000'000}}) {
    FramePairer pairer(kTolerance_s);
    std::size_t frames = 0;
    for (std::uint64_t i = 0; i < 10; ++i) {
      const std::uint64_t us = i < 5 ? 5'000'000 + i * 100'000 : after + i * 100'000;
      frames += pairer.add_depth(picture(us)) ? 1U : 0U;
      frames += pairer.add_colour(picture(us + 3'000)) ? 1U : 0U;
    }
    EXPECT_EQ(frames, 10U);
  }
}

TEST(FramePairer, PairsAreCloseAndEveryPictureIsUsedOnce) {
  Random random(5);
  FramePairer pairer(kTolerance_s);
  std::vector<std::uint64_t> colours, depths;
  const auto keep = [&](const std::optional<CameraFrame>& frame) {
    if (!frame) return;
    const double apart_us =
        static_cast<double>(frame->colour.time_us) - static_cast<double>(frame->depth.time_us);
    EXPECT_LT(std::abs(apart_us), 1e6 * kTolerance_s);
    colours.push_back(frame->colour.time_us);
    depths.push_back(frame->depth.time_us);
  };
  for (std::uint64_t i = 1; i < 2000; ++i) {
    const std::uint64_t us = i * 100'000 + random.index(8'000);
    const bool colour_first = random.uniform() < 0.5;
    const bool has_colour = random.uniform() < 0.9, has_depth = random.uniform() < 0.9;
    if (has_colour && colour_first) keep(pairer.add_colour(picture(us)));
    if (has_depth) keep(pairer.add_depth(picture(us + random.index(8'000))));
    if (has_colour && !colour_first) keep(pairer.add_colour(picture(us)));
  }
  EXPECT_GT(colours.size(), 1500U);
  for (std::size_t i = 1; i < colours.size(); ++i) {
    ASSERT_LT(colours[i - 1], colours[i]);
    ASSERT_LT(depths[i - 1], depths[i]);
  }
}

}  // namespace
}  // namespace cpslam
