#include "detect/person_confirm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "detect/depth_scene.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::kCameraHeightM;
using scene::View;

/// Detections in a scene that does not change; people stay where they were found.
class PersonConfirmTest : public testing::Test {
 protected:
  void detect(const std::vector<PersonBox>& boxes) {
    confirm_people(camera, view.depth_m, StillSurface::begin(view.depth_m), time_s, boxes, {}, random,
                   tracks);
  }
  /// Detections ten times a second, all of which see the boxes.
  void detect_for(double duration_s, const std::vector<PersonBox>& boxes) {
    for (const double end_s = time_s + duration_s - 1e-6; time_s < end_s;) {
      time_s += 0.1;
      detect(boxes);
      // Carried on, everybody is found again where he is.
      for (PersonTrack& track : tracks) {
        if (track.shape.size() > 0) track.seen_s = time_s;
      }
    }
  }
  [[nodiscard]] PersonBox box(std::uint8_t number) const { return scene::box_of(view, number); }
  /// The track whose surface is most of somebody's.
  [[nodiscard]] const PersonTrack* who_is(std::uint8_t number) const {
    const auto found = std::find_if(tracks.begin(), tracks.end(), [&](const PersonTrack& t) {
      return scene::overlap(t.visible.cells, scene::cells_of(view, number)) > 0.6;
    });
    return found == tracks.end() ? nullptr : &*found;
  }

  GridCamera camera = scene::grid_camera();
  View view = DepthScene()
                  .wall(4.5F)
                  .floor()
                  .person({1, {-0.5F, kCameraHeightM, 2.6F}})
                  .person({2, {0.6F, kCameraHeightM, 3.2F}})
                  .look(camera);
  cv::Mat1b blank = scene::blank(view);
  Random random{1};
  double time_s = 100.0;
  std::vector<PersonTrack> tracks;
};

TEST_F(PersonConfirmTest, BoxesStartPeople) {
  detect({box(1), box(2)});
  ASSERT_EQ(tracks.size(), 2U);
  ASSERT_NE(who_is(1), nullptr);
  ASSERT_NE(who_is(2), nullptr);
  EXPECT_NE(tracks[0].number, tracks[1].number);
  for (const PersonTrack& track : tracks) {
    EXPECT_NE(track.number, 0);
    EXPECT_EQ(track.confirmations, 1);
    EXPECT_EQ(track.misses, 0);
    EXPECT_EQ(track.confirmed_s, time_s);
    EXPECT_EQ(track.seen_s, time_s);
    EXPECT_EQ(track.shape.cells, track.visible.cells);
    EXPECT_EQ(track.visible.cells.size(), track.visible.depth_m.size());
  }
}

TEST_F(PersonConfirmTest, BoxesConfirmWhomTheyShowWhateverTheirOrder) {
  detect({box(1), box(2)});
  const int first = who_is(1)->number;
  const int second = who_is(2)->number;
  time_s += 0.1;
  detect({box(2), box(1)});
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_EQ(who_is(1)->number, first);
  EXPECT_EQ(who_is(2)->number, second);
  EXPECT_EQ(who_is(1)->confirmations, 2);
  EXPECT_EQ(who_is(1)->confirmed_s, time_s);
}

TEST_F(PersonConfirmTest, ABoxThatJittersIsTheSamePersons) {
  detect({box(1)});
  for (int i = 0; i < 10; ++i) {
    time_s += 0.1;
    PersonBox jittered = box(1);
    jittered.x += 0.1 * jittered.width * random.normal();
    jittered.y += 0.05 * jittered.height * random.normal();
    detect({jittered});
    ASSERT_EQ(tracks.size(), 1U) << i;
  }
  EXPECT_NE(who_is(1), nullptr);
}

TEST_F(PersonConfirmTest, SomebodyNewJoinsThoseWhoAreKnown) {
  detect_for(0.5, {box(1)});
  detect({box(1), box(2)});
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_GT(who_is(1)->confirmations, 3);
  EXPECT_EQ(who_is(2)->confirmations, 1);
}

TEST_F(PersonConfirmTest, AMissedDetectionKeepsHim) {
  detect_for(1.0, {box(1), box(2)});
  detect_for(0.2, {box(2)});
  ASSERT_NE(who_is(1), nullptr);
  EXPECT_EQ(who_is(1)->misses, 2);
  detect_for(0.1, {box(1), box(2)});
  EXPECT_EQ(who_is(1)->misses, 0);
  EXPECT_EQ(tracks.size(), 2U);
}

TEST_F(PersonConfirmTest, WhoIsMissedForLongIsForgotten) {
  detect_for(1.0, {box(1), box(2)});
  detect_for(3.0, {box(2)});
  EXPECT_EQ(who_is(1), nullptr);
  EXPECT_NE(who_is(2), nullptr);
}

TEST_F(PersonConfirmTest, WhoWasDetectedSeldomIsForgottenSooner) {
  const auto misses_survived = [this](int n_detected) {
    const PersonBox chair{500.0, 60.0, 100.0, 100.0, 0.4};
    detect_for(1.0, {box(1)});
    for (int i = 0; i < n_detected; ++i) detect_for(0.1, {box(1), chair});
    EXPECT_EQ(tracks.size(), 2U);
    int misses = 0;
    for (; misses < 50; ++misses) {
      detect_for(0.1, {box(1)});
      if (tracks.size() < 2U) break;
    }
    EXPECT_NE(who_is(1), nullptr);
    return misses;
  };
  EXPECT_EQ(misses_survived(1), 2) << "0.2 s";
  EXPECT_EQ(misses_survived(3), 3) << "as often as he was detected";
  EXPECT_EQ(misses_survived(10), 7) << "0.7 s";
}

TEST_F(PersonConfirmTest, DetectorsCutOffHandsThatStayHis) {
  detect({box(1)});
  const PersonBox whole = box(1);
  const auto all = double(who_is(1)->visible.size());
  PersonBox cut = whole;
  cut.height *= 0.9;
  time_s += 0.1;
  detect({cut});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_GT(double(tracks[0].visible.size()), 0.95 * all);
}

TEST_F(PersonConfirmTest, ABoxWithoutDepthIsKeptAsABoxForAMoment) {
  view.depth_m.setTo(0.0F);
  detect({{100.0, 100.0, 100.0, 200.0, 0.9}});
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_EQ(tracks[0].visible.size(), 0U);
  EXPECT_EQ(tracks[0].box.width, 100.0);
  forget_people(time_s + 0.03, blank, tracks);
  EXPECT_EQ(tracks.size(), 1U);
  forget_people(time_s + 1.0, blank, tracks);
  EXPECT_TRUE(tracks.empty());
}

TEST_F(PersonConfirmTest, NumbersOfPeopleGoneAreUsedAgain) {
  detect({box(1)});
  const int number = tracks[0].number;
  tracks.clear();
  detect({box(2)});
  EXPECT_EQ(tracks[0].number, number);
}

TEST_F(PersonConfirmTest, AHugeCrowdIsCutOffAtItsLimit) {
  std::vector<PersonBox> boxes;
  for (int i = 0; i < 400; ++i) boxes.push_back({(i % 25) * 25.0, (i / 25) * 30.0, 22.0, 27.0, 0.9});
  detect(boxes);
  EXPECT_GT(tracks.size(), 100U);
  EXPECT_LE(tracks.size(), 254U);
  std::set<int> numbers;
  for (const PersonTrack& track : tracks) numbers.insert(track.number);
  EXPECT_EQ(numbers.size(), tracks.size());
  EXPECT_FALSE(numbers.contains(0));
  time_s += 0.1;
  detect(boxes);
  EXPECT_LE(tracks.size(), 254U);
}

TEST_F(PersonConfirmTest, ForgetsWhoIsNotFoundAgain) {
  detect({box(1), box(2)});
  tracks[1].seen_s = time_s + 1.5;
  forget_people(time_s + 0.2, blank, tracks);
  EXPECT_EQ(tracks.size(), 2U);
  forget_people(time_s + 1.5, blank, tracks);
  EXPECT_EQ(tracks.size(), 1U);
}

TEST_F(PersonConfirmTest, ForgetsWhomNoDetectorHasSeenForVeryLong) {
  detect({box(1)});
  tracks[0].seen_s = time_s + 2.0;
  forget_people(time_s + 2.0, blank, tracks);
  EXPECT_EQ(tracks.size(), 1U);
  tracks[0].seen_s = time_s + 30.0;
  forget_people(time_s + 30.0, blank, tracks);
  EXPECT_TRUE(tracks.empty());
}

TEST_F(PersonConfirmTest, NothingDetectedWhereNobodyIsKnown) {
  detect({});
  EXPECT_TRUE(tracks.empty());
}

}  // namespace
}  // namespace cpslam
