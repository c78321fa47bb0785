// The window itself, on a virtual display: what is in its picture, and what its user can do.
#include "viewer/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cpslam/error.h"
#include "io/temporary_folder.h"
#include "support/virtual_display.h"
#include "support/window_user.h"
#include "viewer/sample_scene.h"

namespace cpslam::viewer {
namespace {

using test::VirtualDisplay;
using test::WindowUser;

constexpr int kWidth = 1200;
constexpr int kHeight = 700;
constexpr int kColumn = 480;  // of the camera, px

bool never() {
  return false;
}

class ViewerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!display.running()) GTEST_SKIP() << VirtualDisplay::kMissing;
  }

  [[nodiscard]] ViewerOptions options(const std::string& picture = {}) const {
    ViewerOptions options;
    options.camera = sample::camera();
    options.size = {kWidth, kHeight};
    options.screenshot_folder = folder.path();
    options.final_picture = picture;
    return options;
  }

  /// The window with these on the board.
  cv::Mat picture_of(const MapSnapshot& map, const FrameSnapshot& frame, const Trajectory& truth = {}) {
    const auto board = std::make_shared<SnapshotBoard>();
    board->publish(std::make_shared<const MapSnapshot>(map));
    board->publish(std::make_shared<const FrameSnapshot>(frame));
    ViewerOptions with_picture = options(folder.path() + "/window.png");
    with_picture.truth = truth;
    RunControl control;
    Viewer viewer(with_picture, board, control);
    viewer.run([] { return true; }, never);
    EXPECT_TRUE(control.quitting());
    return cv::imread(folder.path() + "/window.png");
  }

  TemporaryFolder folder;
  VirtualDisplay display;
};

/// Pixels of exactly this colour.
int count(const cv::Mat& picture, Colour colour) {
  cv::Mat same;
  const cv::Scalar bgr(colour.blue, colour.green, colour.red);
  cv::inRange(picture, bgr, bgr, same);
  return cv::countNonZero(same);
}

int differences(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  cv::Mat any;
  cv::transform(difference, any, cv::Matx13f(1.0F, 1.0F, 1.0F));
  return cv::countNonZero(any);
}

cv::Mat camera_part(const cv::Mat& picture) {
  return picture(cv::Rect(0, 0, kColumn, kHeight));
}
cv::Mat map_part(const cv::Mat& picture) {
  // Without the words in its upper corner.
  return picture(cv::Rect(kColumn, 80, kWidth - kColumn, kHeight - 80));
}

TEST_F(ViewerTest, ShowsTheCamerasImageWithKeypointsBoxesAndPeople) {
  const FrameSnapshot frame = sample::frame(7);
  const cv::Mat picture = picture_of(sample::map(2000, 12), frame);
  ASSERT_EQ(picture.size(), cv::Size(kWidth, kHeight));
  const cv::Mat camera = camera_part(picture);
  EXPECT_GT(count(camera, {110, 100, 90}), 30000) << "the image itself, its B,G,R turned";
  EXPECT_GT(count(camera, kBox), 600);
  EXPECT_GT(count(camera, kRemoved), 200);
  EXPECT_GT(count(camera, kTracked), 1500);
  EXPECT_GT(count(camera, kKept), 700);
  FrameSnapshot empty = frame;
  empty.view = {};
  const cv::Mat bare = camera_part(picture_of(sample::map(2000, 12), empty));
  EXPECT_LT(count(bare, kBox), 60) << "the legend's dot";
  EXPECT_LT(count(bare, kRemoved), 60);
  // Where somebody is, without a keypoint and within his box.
  const double scale = (kColumn - 28.0) / 640.0;
  const cv::Point his(14 + static_cast<int>(scale * 331), 48 + static_cast<int>(scale * 271));
  EXPECT_NE(camera.at<cv::Vec3b>(his), bare.at<cv::Vec3b>(his)) << "he is tinted";
}

TEST_F(ViewerTest, ShowsEachPartOfTheMap) {
  const MapSnapshot map = sample::map(4000, 12);
  const FrameSnapshot frame = sample::frame(7);
  const cv::Mat whole = map_part(picture_of(map, frame));
  const auto without = [&](const auto& take_away) {
    MapSnapshot less = map;
    FrameSnapshot lesser = frame;
    take_away(less, lesser);
    return differences(whole, map_part(picture_of(less, lesser)));
  };
  EXPECT_EQ(without([](MapSnapshot&, FrameSnapshot&) {}), 0) << "the same twice";
  EXPECT_GT(without([](MapSnapshot& m, FrameSnapshot&) {
              // The overview's frame comes from some of the points: these leave it as it is.
              m.points.resize(m.points.size() / 2);
            }),
            2000);
  EXPECT_GT(without([](MapSnapshot& m, FrameSnapshot&) { m.loops.clear(); }), 20);
  EXPECT_GT(without([](MapSnapshot& m, FrameSnapshot&) { m.covisibility.clear(); }), 100);
  EXPECT_GT(without([](MapSnapshot&, FrameSnapshot& f) { f.people.clear(); }), 500);
  EXPECT_GT(without([](MapSnapshot&, FrameSnapshot& f) { f.result.state = TrackingState::kLost; }), 100)
      << "no pose, no camera";
  EXPECT_GT(without([](MapSnapshot&, FrameSnapshot& f) {
              for (const double x : {0.5, 0.6, 0.7}) f.tracked_points.push_back({float(x), 0.0F, 0.0F});
            }),
            10);
}

TEST_F(ViewerTest, ShowsKeyframesTrajectoryAndTruthInTheirColours) {
  MapSnapshot map = sample::map(0, 12);
  map.covisibility.clear();
  const cv::Mat without_truth = map_part(picture_of(map, sample::frame(7)));
  const cv::Mat with_truth = map_part(picture_of(map, sample::frame(7), map.trajectory));
  EXPECT_GT(count(without_truth, kTrajectory), 200);
  EXPECT_GT(count(without_truth, kLoop), 20);
  EXPECT_GT(count(without_truth, kCamera), 40);
  EXPECT_GT(differences(with_truth, without_truth), 200);
  map.keyframes.resize(1);
  map.loops.clear();
  map.spanning_tree.clear();
  EXPECT_GT(differences(without_truth, map_part(picture_of(map, sample::frame(7)))), 500);
}

TEST_F(ViewerTest, NothingYetIsAWindowAllTheSame) {
  const auto board = std::make_shared<SnapshotBoard>();
  RunControl control;
  Viewer viewer(options(), board, control);
  viewer.draw_once();
  EXPECT_EQ(board->frame_wish(), SnapshotWish::kWhenCheap);
  EXPECT_EQ(board->map_wish(), SnapshotWish::kWhenCheap);
}

TEST_F(ViewerTest, ClosingTheWindowQuitsTheRun) {
  RunControl control;
  Viewer viewer(options(), std::make_shared<SnapshotBoard>(), control);
  viewer.draw_once();
  const WindowUser user("CP-SLAM");
  EXPECT_FALSE(control.quitting());
  user.close();
  viewer.run(never, never);
  EXPECT_TRUE(control.quitting());
}

TEST_F(ViewerTest, KeysPauseStepGoOnAndSaveThePicture) {
  RunControl control;
  const auto board = std::make_shared<SnapshotBoard>();
  board->publish(std::make_shared<const FrameSnapshot>(sample::frame(7)));
  Viewer viewer(options(), board, control);
  viewer.draw_once();
  const WindowUser user("CP-SLAM");
  const std::string picture = folder.path() + "/viewer-000007.png";
  int stage = 0;
  // Each stage presses the next key once it sees what the last one did.
  const auto watch = [&] {
    if (stage == 0) {
      user.press("space");
      ++stage;
    } else if (stage == 1 && control.paused()) {
      EXPECT_EQ(board->frame_wish(), SnapshotWish::kEvery) << "step by step, every frame is wanted";
      user.press("n");
      ++stage;
    } else if (stage == 2 && control.paused()) {
      user.press("s");
      ++stage;
    } else if (stage == 3 && std::filesystem::exists(picture)) {
      user.press("space");
      ++stage;
    } else if (stage == 4 && !control.paused()) {
      user.press("q");
      ++stage;
    }
    return false;
  };
  viewer.run(watch, never);
  EXPECT_EQ(stage, 5);
  EXPECT_EQ(cv::imread(picture).size(), cv::Size(kWidth, kHeight));
  EXPECT_TRUE(control.quitting());
}

TEST_F(ViewerTest, LocalisationIsSwitchedByKeyAndShownAsTheFramesSayItIs) {
  RunControl control;
  const auto board = std::make_shared<SnapshotBoard>();
  board->publish(std::make_shared<const FrameSnapshot>(sample::frame(7)));
  Viewer viewer(options(), board, control);
  viewer.draw_once();
  const WindowUser user("CP-SLAM");
  std::vector<bool> wishes;
  std::uint64_t index = 7;
  const auto watch = [&] {
    if (wishes.empty() && index == 7) {
      user.press("l");
      ++index;
    }
    if (const std::optional<bool> wish = control.wishes().localization) {
      wishes.push_back(*wish);
      EXPECT_FALSE(control.take_wishes().reset);
      FrameSnapshot obeyed = sample::frame(++index);
      obeyed.localization = *wish;
      board->publish(std::make_shared<const FrameSnapshot>(obeyed));
      user.press(wishes.size() < 3 ? "l" : "q");
    }
    return false;
  };
  viewer.run(watch, never);
  EXPECT_EQ(wishes, (std::vector<bool>{true, false, true}));
}

TEST_F(ViewerTest, TheMapIsDroppedOnlyAtTheSecondPress) {
  RunControl control;
  Viewer viewer(options(), std::make_shared<SnapshotBoard>(), control);
  viewer.draw_once();
  const WindowUser user("CP-SLAM");
  const std::string picture = folder.path() + "/viewer-000000.png";
  int stage = 0;
  const auto watch = [&] {
    if (stage == 0) {
      user.press("r");
      user.press("s");  // its file tells that the first press has arrived
      ++stage;
    } else if (stage == 1 && std::filesystem::exists(picture)) {
      EXPECT_FALSE(control.wishes().reset);
      user.press("r");
      ++stage;
    } else if (stage == 2 && control.wishes().reset) {
      user.press("q");
      ++stage;
    }
    return false;
  };
  viewer.run(watch, never);
  EXPECT_EQ(stage, 3);
}

TEST_F(ViewerTest, AnEmptyMapAfterAFullOneIsDrawnToo) {
  const cv::Mat empty = map_part(picture_of(MapSnapshot{}, sample::frame(7)));
  const auto board = std::make_shared<SnapshotBoard>();
  board->publish(std::make_shared<const MapSnapshot>(sample::map(2000, 12)));
  board->publish(std::make_shared<const FrameSnapshot>(sample::frame(7)));
  RunControl control;
  Viewer viewer(options(folder.path() + "/reset.png"), board, control);
  viewer.draw_once();
  board->publish(std::make_shared<const MapSnapshot>());
  viewer.run([] { return true; }, never);
  const cv::Mat reset = map_part(cv::imread(folder.path() + "/reset.png"));
  EXPECT_EQ(count(reset, kTrajectory), count(empty, kTrajectory));
  EXPECT_EQ(count(reset, kLoop), count(empty, kLoop)) << "the switch of that layer alone";
}

TEST_F(ViewerTest, ALiveCameraIsNotPaused) {
  RunControl control;
  ViewerOptions live = options();
  live.can_pause = false;
  Viewer viewer(live, std::make_shared<SnapshotBoard>(), control);
  viewer.draw_once();
  const WindowUser user("CP-SLAM");
  user.press("space");
  user.press("n");
  user.press("q");
  viewer.run(never, never);
  EXPECT_FALSE(control.paused());
}

TEST_F(ViewerTest, AnInterruptClosesIt) {
  RunControl control;
  Viewer viewer(options(), std::make_shared<SnapshotBoard>(), control);
  viewer.run(never, [] { return true; });
  EXPECT_TRUE(control.quitting());
}

TEST_F(ViewerTest, APictureThatCannotBeWrittenIsAnError) {
  RunControl control;
  Viewer viewer(options(folder.path() + "/no/such/folder/window.png"), std::make_shared<SnapshotBoard>(),
                control);
  EXPECT_THROW(viewer.run([] { return true; }, never), RunError);
}

TEST_F(ViewerTest, SmallWindowsAreDrawnToo) {
  ViewerOptions small = options();
  small.size = {120, 90};
  RunControl control;
  const auto board = std::make_shared<SnapshotBoard>();
  board->publish(std::make_shared<const MapSnapshot>(sample::map(100, 3)));
  board->publish(std::make_shared<const FrameSnapshot>(sample::frame(1)));
  Viewer viewer(small, board, control);
  for (int i = 0; i < 3; ++i) viewer.draw_once();
}

TEST(ViewerWithoutDisplay, SaysSo) {
  unsetenv("DISPLAY");
  RunControl control;
  try {
    Viewer viewer({}, std::make_shared<SnapshotBoard>(), control);
    FAIL() << "a window without a display";
  } catch (const RunError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("display"));
  }
}

}  // namespace
}  // namespace cpslam::viewer
