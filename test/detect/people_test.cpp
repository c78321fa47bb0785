#include "detect/people.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cpslam/error.h"
#include "detect/depth_scene.h"
#include "detect/detector_doubles.h"
#include "support/synthetic.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::View;

/// Frames of somebody before a wall, who stands still.
class PeopleTest : public testing::Test {
 protected:
  PeopleTest() {
    settings.camera = scene::camera_settings();
    settings.sequential = true;
    const DepthScene room = DepthScene().wall(4.0F).person({1, {0.1F, scene::kCameraHeightM, 2.2F}});
    close = room.look_close(PinholeCamera(settings.camera));
    box = scene::box_of(room.look(scene::grid_camera()), 1);
    keypoints_every_px(24);
  }
  void keypoints_every_px(int step) {
    candidates = {};
    Random looks(1);
    for (int y = step / 2; y < 480; y += step) {
      for (int x = step / 2; x < 640; x += step) {
        candidates.orb.keypoints.push_back({float(x), float(y)});
        candidates.orb.descriptors.push_back(synthetic::random_descriptor(looks));
        candidates.undistorted.push_back({float(x), float(y)});
        candidates.depth.push_back({close.depth_m(y, x), 0.01F});
      }
    }
  }
  RgbdFrame next_frame() {
    RgbdFrame frame;
    frame.colour = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90));
    frame.depth = scene::raw_depth(close);
    frame.time_s = time_s += 1.0 / 30.0;
    return frame;
  }
  RgbdFrame next_frame(std::vector<PersonBox> boxes) {
    RgbdFrame frame = next_frame();
    frame.boxes = std::move(boxes);
    return frame;
  }
  std::vector<std::uint8_t> run(People& people, const RgbdFrame& frame) {
    people.check(frame);
    people.begin(frame, SE3());
    const std::vector<std::uint8_t> keep = people.filter(candidates);
    people.end(SE3(), true);
    return keep;
  }
  [[nodiscard]] People make(std::unique_ptr<PersonDetector> detector = nullptr) {
    return {settings, std::move(detector), timer, book.log()};
  }
  [[nodiscard]] bool on_person(std::size_t i) const {
    return close.owner(int(candidates.orb.keypoints[i].y), int(candidates.orb.keypoints[i].x)) != 0;
  }
  /// Of the keypoints on him, and of the others.
  [[nodiscard]] std::pair<double, double> kept_shares(const std::vector<std::uint8_t>& keep) const {
    double his = 0.0, his_kept = 0.0, others = 0.0, others_kept = 0.0;
    for (std::size_t i = 0; i < keep.size(); ++i) {
      (on_person(i) ? his : others) += 1.0;
      (on_person(i) ? his_kept : others_kept) += keep[i];
    }
    return {his_kept / his, others_kept / others};
  }
  void expect_filtered(const std::vector<std::uint8_t>& keep) const {
    ASSERT_EQ(keep.size(), candidates.orb.keypoints.size());
    const auto [his, others] = kept_shares(keep);
    EXPECT_LT(his, 0.1);
    EXPECT_GT(others, 0.95);
  }
  static bool all_kept(const std::vector<std::uint8_t>& keep) {
    return std::all_of(keep.begin(), keep.end(), [](std::uint8_t k) { return k == 1; });
  }

  Settings settings;
  View close;
  PersonBox box;
  KeypointCandidates candidates;
  StageTimer timer;
  LogBook book;
  double time_s = 500.0;
};

TEST_F(PeopleTest, WithoutDetectorAndBoxesAllStays) {
  People people = make();
  EXPECT_TRUE(all_kept(run(people, next_frame())));
  FrameView view;
  people.show(view);
  EXPECT_TRUE(view.boxes.empty());
  EXPECT_FALSE(view.boxes_time_s);
  EXPECT_TRUE(view.person_mask.empty());
  EXPECT_TRUE(people.prior().people.empty());
}

TEST_F(PeopleTest, TheCallersBoxesNeedNoDetector) {
  People people = make();
  expect_filtered(run(people, next_frame({box})));
  FrameView view;
  people.show(view);
  ASSERT_EQ(view.boxes.size(), 1U);
  EXPECT_EQ(view.boxes_time_s, time_s);
  const cv::Mat person = view.person_mask != 0, truth = close.owner != 0;
  EXPECT_GT(double(cv::countNonZero(person & truth)), 0.9 * double(cv::countNonZero(person | truth)));
}

TEST_F(PeopleTest, TheCallersBoxesAreCarriedIntoFramesWithoutAny) {
  People people = make();
  run(people, next_frame({box}));
  for (int i = 0; i < 5; ++i) expect_filtered(run(people, next_frame()));
}

TEST_F(PeopleTest, FiltersWhatItsDetectorFinds) {
  std::atomic<int> calls{0};
  People people = make(detector_that([&](double) {
    ++calls;
    return std::vector{box};
  }));
  for (int i = 0; i < 3; ++i) expect_filtered(run(people, next_frame()));
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(book.at(LogLevel::kInfo).at(0), "people: the test's own");
}

TEST_F(PeopleTest, TheCallersBoxesStandInTheDetectorsPlaceEvenNone) {
  std::atomic<int> calls{0};
  People people = make(detector_that([&](double) {
    ++calls;
    return std::vector{box};
  }));
  EXPECT_TRUE(all_kept(run(people, next_frame(std::vector<PersonBox>{}))));
  EXPECT_EQ(calls, 0);
}

TEST_F(PeopleTest, TheCallersMaskIsRemovedFromItsFrameOnly) {
  People people = make();
  RgbdFrame frame = next_frame();
  frame.moving_mask = cv::Mat::zeros(480, 640, CV_8UC1);
  const cv::Rect cart(400, 200, 120, 100);
  frame.moving_mask(cart).setTo(1);
  people.begin(frame, SE3());
  const std::vector<std::uint8_t> keep = people.filter(candidates);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const OrbKeypoint& k = candidates.orb.keypoints[i];
    EXPECT_EQ(keep[i] == 0, cart.contains({int(k.x), int(k.y)})) << k.x << ' ' << k.y;
  }
  const cv::Mat excluded = people.excluded();
  EXPECT_EQ(cv::countNonZero(excluded(cart)), cart.area());
  people.end(SE3(), true);
  EXPECT_TRUE(all_kept(run(people, next_frame())));
}

TEST_F(PeopleTest, MaskAndBoxesWorkTogether) {
  People people = make();
  RgbdFrame frame = next_frame({box});
  frame.moving_mask = cv::Mat::zeros(480, 640, CV_8UC1);
  frame.moving_mask(cv::Rect(0, 0, 60, 480)).setTo(255);
  people.begin(frame, SE3());
  const std::vector<std::uint8_t> keep = people.filter(candidates);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (candidates.orb.keypoints[i].x < 60.0F) {
      EXPECT_EQ(keep[i], 0);
    }
  }
  EXPECT_LT(kept_shares(keep).first, 0.1);
  const cv::Mat excluded = people.excluded();
  EXPECT_EQ(excluded.size(), cv::Size(640, 480));
  EXPECT_NE(excluded.at<std::uint8_t>(240, 10), 0);
  EXPECT_GT(cv::countNonZero(excluded & close.owner), cv::countNonZero(close.owner) * 9 / 10);
}

TEST_F(PeopleTest, AMaskOfAnotherTypeOrSizeIsRefused) {
  const People people = make();
  RgbdFrame frame = next_frame();
  EXPECT_NO_THROW(people.check(frame));
  frame.moving_mask = cv::Mat::zeros(480, 640, CV_8UC1);
  EXPECT_NO_THROW(people.check(frame));
  for (const cv::Mat& wrong :
       {cv::Mat(480, 640, CV_16UC1), cv::Mat(480, 640, CV_8UC3), cv::Mat(120, 160, CV_8UC1)}) {
    frame.moving_mask = wrong;
    EXPECT_THROW(people.check(frame), InputError);
  }
}

TEST_F(PeopleTest, ExpectsNobodyBeforeTheFirstBoxes) {
  People people = make(detector_that([&](double) { return std::vector{box}; }));
  const RgbdFrame first = next_frame();
  people.begin(first, SE3());
  EXPECT_TRUE(people.prior().people.empty());
  const auto keep = people.filter(candidates);
  people.end(SE3(), true);
  people.begin(next_frame(), SE3());
  const cv::Mat expected = people.prior().people;
  ASSERT_EQ(expected.size(), cv::Size(160, 120));
  EXPECT_GT(cv::countNonZero(expected), 0);
  // Where he is.
  int inside = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x)
      inside += expected.at<std::uint8_t>(y, x) != 0 && close.owner(4 * y + 2, 4 * x + 2) != 0 ? 1 : 0;
  }
  EXPECT_GT(inside, cv::countNonZero(expected) * 8 / 10);
}

TEST_F(PeopleTest, AsksForAsManyMoreAsAreMissing) {
  People people = make();
  people.begin(next_frame({box}), SE3());
  const auto keep = people.filter(candidates);
  const auto kept = int(std::count(keep.begin(), keep.end(), std::uint8_t{1}));
  const int missing = people.missing_keypoints(keep);
  EXPECT_GT(missing, 0);
  EXPECT_EQ(kept + missing, 500);
  EXPECT_EQ(people.statistics().extended_frames, 1U);
  EXPECT_EQ(cv::countNonZero(people.excluded() != 0) > 0, true);
}

TEST_F(PeopleTest, AsksForNoMoreThanTheFrameWouldHave) {
  settings.orb.n_features = 300;
  keypoints_every_px(40);
  People people = make();
  people.begin(next_frame({box}), SE3());
  const auto keep = people.filter(candidates);
  EXPECT_EQ(int(std::count(keep.begin(), keep.end(), std::uint8_t{1})) + people.missing_keypoints(keep), 300);
}

TEST_F(PeopleTest, AsksForNoneWhereThereAreEnoughOrNobodyIs) {
  keypoints_every_px(16);
  People people = make();
  people.begin(next_frame({box}), SE3());
  EXPECT_EQ(people.missing_keypoints(people.filter(candidates)), 0);
  people.end(SE3(), true);
  keypoints_every_px(60);
  People alone = make();
  alone.begin(next_frame(std::vector<PersonBox>{}), SE3());
  EXPECT_EQ(alone.missing_keypoints(alone.filter(candidates)), 0);
  EXPECT_EQ(alone.statistics().extended_frames, 0U);
}

TEST_F(PeopleTest, SaysOnceThatFramesGetMore) {
  People people = make();
  for (int i = 0; i < 3; ++i) {
    people.begin(next_frame({box}), SE3());
    const auto keep = people.filter(candidates);
    EXPECT_GT(people.missing_keypoints(keep), 0);
    people.end(SE3(), true);
  }
  EXPECT_EQ(people.statistics().extended_frames, 3U);
  EXPECT_EQ(book.at(LogLevel::kInfo).size(), 1U);
}

TEST_F(PeopleTest, FiltersAgainAfterTheCandidatesWereExtended) {
  std::atomic<int> calls{0};
  People people = make(detector_that([&](double) {
    ++calls;
    return std::vector{box};
  }));
  people.begin(next_frame(), SE3());
  const auto before = people.filter(candidates);
  keypoints_every_px(12);
  expect_filtered(people.filter(candidates));
  people.end(SE3(), true);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(people.statistics().keypoints, candidates.orb.keypoints.size()) << "counted once, as they ended";
}

TEST_F(PeopleTest, CountsWhatItDid) {
  People people = make();
  std::size_t removed = 0;
  for (int i = 0; i < 4; ++i) {
    const auto keep = run(people, i % 2 == 0 ? next_frame({box, {0.0, 0.0, 30.0, 30.0}}) : next_frame());
    removed += std::size_t(std::count(keep.begin(), keep.end(), std::uint8_t{0}));
  }
  const PeopleStatistics statistics = people.statistics();
  EXPECT_EQ(statistics.detections, 2U);
  EXPECT_EQ(statistics.boxes, 4U);
  EXPECT_EQ(statistics.keypoints, 4 * candidates.orb.keypoints.size());
  EXPECT_EQ(statistics.removed_keypoints, removed);
  EXPECT_GT(removed, 0U);
  EXPECT_NEAR(statistics.mean_boxes_age_s, 0.5 / 30.0, 1e-6);
  EXPECT_NEAR(statistics.max_boxes_age_s, 1.0 / 30.0, 1e-6);
  EXPECT_EQ(statistics.detector_failures, 0U);
  EXPECT_FALSE(statistics.detector_stuck);
}

TEST_F(PeopleTest, ADetectorThatFailsIsCountedAndFramesGoOn) {
  int calls = 0;
  People people = make(detector_that([&](double) {
    if (++calls > 1) throw std::runtime_error("out of luck");
    return std::vector{box};
  }));
  for (int i = 0; i < 4; ++i) expect_filtered(run(people, next_frame()));
  EXPECT_EQ(people.statistics().detector_failures, 3U);
  EXPECT_EQ(people.statistics().detections, 4U);
  EXPECT_FALSE(book.at(LogLevel::kWarning).empty() && book.at(LogLevel::kError).empty());
}

TEST_F(PeopleTest, LateBoxesAreCarriedIntoTheFrameAtHand) {
  settings.detector.policy = BoxesPolicy::kLatest;
  settings.detector.pretend_rate_hz = 6.0;
  settings.detector.pretend_delay_s = 0.15;
  People people = make(detector_that([&](double) { return std::vector{box}; }));
  const double begin_s = time_s + 1.0 / 30.0;
  for (int i = 0; i < 20; ++i) {
    const auto keep = run(people, next_frame());
    if (time_s < begin_s + 0.14) {
      EXPECT_TRUE(all_kept(keep)) << i;
    } else if (time_s > begin_s + 0.16) {
      expect_filtered(keep);
    }
  }
  EXPECT_GE(people.statistics().mean_boxes_age_s, 0.15);
  EXPECT_LT(people.statistics().max_boxes_age_s, 0.5);
}

TEST_F(PeopleTest, CanDeleteWholeBoxes) {
  settings.people.filter = PeopleFilter::kBoxes;
  People people = make();
  const auto keep = run(people, next_frame({box}));
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const OrbKeypoint& k = candidates.orb.keypoints[i];
    const bool inside = double(k.x) >= box.x && double(k.y) >= box.y && double(k.x) < box.x + box.width &&
                        double(k.y) < box.y + box.height;
    EXPECT_EQ(keep[i] == 0, inside);
  }
  EXPECT_EQ(people.missing_keypoints(keep), 0);
  EXPECT_TRUE(people.prior().people.empty());
  FrameView view;
  people.show(view);
  EXPECT_EQ(view.person_mask.size(), cv::Size(640, 480));
  EXPECT_EQ(cv::countNonZero(view.person_mask), 0);
}

TEST_F(PeopleTest, WhatMovesIsUnknownWhileNobodyIsLookedFor) {
  People people = make();
  run(people, next_frame());
  EXPECT_TRUE(people.moving().empty());
}

TEST_F(PeopleTest, WhatMayMoveArePeopleTheirBoxesAndTheCallersMask) {
  People people = make();
  RgbdFrame frame = next_frame({box});
  frame.moving_mask = cv::Mat(480, 640, CV_8UC1, cv::Scalar(0));
  const cv::Rect corner(600, 10, 30, 20);
  frame.moving_mask(corner).setTo(1);
  run(people, frame);
  const auto expect_covered = [&](const cv::Mat& moving) {
    ASSERT_EQ(moving.type(), CV_8UC1);
    cv::Mat person, on_person;
    cv::compare(close.owner, 0, person, cv::CMP_NE);
    moving.copyTo(on_person, person);
    EXPECT_GT(cv::countNonZero(on_person), 0.98 * cv::countNonZero(person));
    EXPECT_LT(cv::countNonZero(moving), 1.1 * box.width * box.height + corner.area());
  };
  expect_covered(people.moving());
  EXPECT_EQ(cv::countNonZero(people.moving()(corner)), corner.area());
  // In a frame without boxes he and his box are carried along, the caller's mask is not.
  run(people, next_frame());
  expect_covered(people.moving());
  EXPECT_EQ(cv::countNonZero(people.moving()(corner)), 0);
}

TEST_F(PeopleTest, WhereOnlyBoxesAreKnownAllInThemMoves) {
  settings.people.filter = PeopleFilter::kBoxes;
  People people = make();
  run(people, next_frame({{600.5, 470.5, 1e300, 1e300}, {-50.0, 10.0, 60.0, 20.0}, {0.0, 0.0, -3.0, NAN}}));
  const cv::Mat moving = people.moving();
  EXPECT_EQ(cv::countNonZero(moving), 40 * 10 + 10 * 20);
  EXPECT_EQ(moving.at<std::uint8_t>(479, 639), 255);
  EXPECT_EQ(moving.at<std::uint8_t>(29, 9), 255);
}

TEST_F(PeopleTest, CanFilterAsPublished) {
  settings.people.filter = PeopleFilter::kPaper;
  keypoints_every_px(8);
  People people = make();
  const auto keep = run(people, next_frame({box}));
  const auto removed = std::count(keep.begin(), keep.end(), std::uint8_t{0});
  EXPECT_GT(removed, 0);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] != 0) continue;
    EXPECT_GE(double(candidates.orb.keypoints[i].x), box.x);
    EXPECT_LT(double(candidates.orb.keypoints[i].x), box.x + box.width);
  }
}

TEST_F(PeopleTest, IsTheSameRunAfterRun) {
  for (const PeopleFilter filter : {PeopleFilter::kSdf, PeopleFilter::kPaper}) {
    settings.people.filter = filter;
    People a = make(), b = make();
    for (int i = 0; i < 3; ++i) {
      const RgbdFrame frame = next_frame({box});
      EXPECT_EQ(run(a, frame), run(b, frame));
    }
  }
}

TEST_F(PeopleTest, ReadsDepthInFloats) {
  People people = make();
  RgbdFrame frame = next_frame({box});
  frame.depth.convertTo(frame.depth, CV_32F);
  frame.depth.at<float>(3, 3) = std::numeric_limits<float>::quiet_NaN();
  expect_filtered(run(people, frame));
}

}  // namespace
}  // namespace cpslam
