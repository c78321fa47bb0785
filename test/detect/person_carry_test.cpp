#include "detect/person_carry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

#include "detect/depth_scene.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::kCameraHeightM;
using scene::Person;
using scene::View;

constexpr double kStepS = 1.0 / 30.0;

/// Every surface has just come into view.
StillSurface nothing_known(const View& view) {
  StillSurface still = StillSurface::begin(view.depth_m);
  still.age.setTo(0);
  still.free_age.setTo(0);
  return still;
}

/// Carries people through a scene from their true surfaces in its first frame on, when the room has long been
/// known and they have just come in.
class Walk {
 public:
  using CameraPath = std::function<SE3(double time_s)>;
  explicit Walk(
      DepthScene room, CameraPath path = [](double) { return SE3(); })
      : room_(std::move(room)), path_(std::move(path)), view_(room_.look(camera_, path_(0.0))) {
    still_ = StillSurface::begin(view_.depth_m);
    still_.free_age.setTo(100);
    still_.free_age.setTo(0, view_.owner != 0);
  }

  PersonTrack& follow(std::uint8_t number,
                      const Eigen::Vector3f& velocity_m_per_s = Eigen::Vector3f::Zero()) {
    tracks_.push_back(scene::track_of(view_, number));
    tracks_.back().velocity_m_per_s = velocity_m_per_s;
    tracks_.back().velocity_variance.setConstant(0.01F);
    return tracks_.back();
  }
  void add_noise(std::uint64_t seed) { noise_.emplace(seed); }
  void step() {
    const SE3 world_from_last = path_(time_s_);
    time_s_ += kStepS;
    View next = room_.look(camera_, path_(time_s_), time_s_);
    if (noise_) scene::add_noise(next, *noise_);
    const SE3 moved = path_(time_s_).inverse() * world_from_last;
    still_ = still_.carry(camera_, next.depth_m, moved);
    carry_people(camera_, {next.depth_m, still_, moved, time_s_, kStepS}, tracks_);
    still_.claim(paint_people(tracks_, camera_.size()));
    view_ = next;
  }
  void steps(int n) {
    for (int i = 0; i < n; ++i) step();
  }
  [[nodiscard]] double iou(std::uint8_t number) const {
    return scene::overlap(track(number).visible.cells, scene::cells_of(view_, number));
  }
  /// Cells of the track that are not the person's, by his.
  [[nodiscard]] double swallowed(std::uint8_t number) const {
    const auto his = double(scene::cells_of(view_, number).size());
    const std::vector<int>& cells = track(number).visible.cells;
    return double(
               std::count_if(cells.begin(), cells.end(), [&](int c) { return view_.owner(c) != number; })) /
           his;
  }
  [[nodiscard]] const PersonTrack& track(std::uint8_t number) const {
    return *std::find_if(tracks_.begin(), tracks_.end(),
                         [number](const PersonTrack& t) { return t.number == number; });
  }
  [[nodiscard]] const View& view() const { return view_; }
  [[nodiscard]] double time_s() const { return time_s_; }

 private:
  GridCamera camera_ = scene::grid_camera();
  DepthScene room_;
  CameraPath path_;
  double time_s_ = 0.0;
  View view_;
  StillSurface still_;
  std::optional<Random> noise_;
  std::vector<PersonTrack> tracks_;
};

Person walker(const Eigen::Vector3f& feet, const Eigen::Vector3f& velocity_m_per_s, std::uint8_t number = 1) {
  return {number, feet, velocity_m_per_s};
}

TEST(PersonCarry, KeepsWhoStands) {
  Walk walk(DepthScene().wall(4.0F).floor().person({1, {0.0F, kCameraHeightM, 2.8F}}));
  walk.follow(1);
  walk.steps(30);
  EXPECT_GT(walk.iou(1), 0.9);
  EXPECT_DOUBLE_EQ(walk.track(1).seen_s, walk.time_s());
}

TEST(PersonCarry, FollowsWhoWalksSideways) {
  const Eigen::Vector3f velocity(1.0F, 0.0F, 0.0F);
  Walk walk(DepthScene().wall(4.5F).floor().person(walker({-0.5F, kCameraHeightM, 2.8F}, velocity)));
  walk.follow(1, velocity);
  const double x_before = walk.track(1).box.x;
  for (int i = 0; i < 30; ++i) {
    walk.step();
    ASSERT_GT(walk.iou(1), 0.65) << i;
  }
  // 1 m at 2.8 m.
  EXPECT_NEAR(walk.track(1).box.x - x_before, 535.4 / 2.7, 25.0);
}

TEST(PersonCarry, FollowsHimInNoise) {
  const Eigen::Vector3f velocity(1.0F, 0.0F, 0.0F);
  Walk walk(DepthScene().wall(4.5F).floor().person(walker({-0.5F, kCameraHeightM, 2.8F}, velocity)));
  walk.add_noise(5);
  walk.follow(1, velocity);
  walk.steps(30);
  EXPECT_GT(walk.iou(1), 0.6);
}

TEST(PersonCarry, FollowsWhoStrollsThoughHisVelocityIsNotKnown) {
  Walk walk(DepthScene().wall(4.5F).person(walker({-0.2F, kCameraHeightM, 2.8F}, {0.4F, 0.0F, 0.0F})));
  walk.follow(1);
  walk.steps(15);
  EXPECT_GT(walk.iou(1), 0.6);
}

TEST(PersonCarry, FollowsWhoComesToTheCamera) {
  const Eigen::Vector3f velocity(0.0F, 0.0F, -1.0F);
  Walk walk(DepthScene().wall(4.5F).floor().person(walker({0.1F, kCameraHeightM, 3.5F}, velocity)));
  walk.follow(1, velocity);
  const double height_before = walk.track(1).box.height;
  for (int i = 0; i < 45; ++i) {
    walk.step();
    ASSERT_GT(walk.iou(1), 0.5) << i;
  }
  // He is at 2 m now.
  EXPECT_NEAR(walk.track(1).box.height / height_before, 3.5 / 2.0, 0.35);
}

TEST(PersonCarry, FindsOutTheVelocityTowardsTheCamera) {
  Walk walk(DepthScene().wall(4.5F).person(walker({0.1F, kCameraHeightM, 3.5F}, {0.0F, 0.0F, -0.8F})));
  walk.follow(1);
  walk.steps(20);
  EXPECT_NEAR(walk.track(1).velocity_m_per_s.z(), -0.8F, 0.25F);
  EXPECT_GT(walk.iou(1), 0.7);
}

TEST(PersonCarry, TakesTheCamerasMotionIntoAccount) {
  // The camera passes by and turns; the person stands.
  const auto path = [](double t) { return scene::world_from_camera_at(0.4 * t, 0.05 * t, 0.3 * t, 0.3 * t); };
  Walk walk(DepthScene().wall(4.5F).floor().person({1, {0.2F, kCameraHeightM, 2.8F}}), path);
  walk.follow(1);
  for (int i = 0; i < 30; ++i) {
    walk.step();
    ASSERT_GT(walk.iou(1), 0.65) << i;
  }
}

TEST(PersonCarry, TurnsTheVelocityWithTheCamera) {
  const auto path = [](double t) { return scene::world_from_camera_at(0.0, 0.0, 0.0, 0.5 * t); };
  Walk walk(DepthScene().wall(6.0F).person(walker({-0.2F, kCameraHeightM, 3.5F}, {0.6F, 0.0F, 0.0F})), path);
  walk.follow(1, {0.6F, 0.0F, 0.0F});
  walk.steps(30);
  // Against the room, in the camera's axes, half a radian on.
  EXPECT_NEAR(walk.track(1).velocity_m_per_s.x(), 0.6F * std::cos(0.5F), 0.15F);
  EXPECT_NEAR(walk.track(1).velocity_m_per_s.z(), 0.6F * std::sin(0.5F), 0.25F);
  EXPECT_GT(walk.iou(1), 0.6);
}

TEST(PersonCarry, FindsWhoWasHiddenBehindSomebodyNearer) {
  // The nearer one passes within half a second.
  const Eigen::Vector3f velocity(2.0F, 0.0F, 0.0F);
  Walk walk(DepthScene()
                .wall(5.0F)
                .person({1, {0.0F, kCameraHeightM, 3.2F}})
                .person(walker({-0.7F, kCameraHeightM, 1.8F}, velocity, 2)));
  walk.follow(1);
  walk.follow(2, velocity);
  std::size_t least = 100000;
  for (int i = 0; i < 24; ++i) {
    walk.step();
    least = std::min(least, walk.track(1).visible.size());
    ASSERT_GT(walk.track(1).shape.size(), 100U) << i;
  }
  EXPECT_LT(least, 300U) << "he was never hidden";
  EXPECT_GT(walk.iou(1), 0.6);
  EXPECT_GT(walk.iou(2), 0.5);
}

TEST(PersonCarry, SaysWhenSomebodyCannotBeFound) {
  // He is gone from one frame to the next, and the wall behind him is not he.
  const GridCamera camera = scene::grid_camera();
  const DepthScene empty = DepthScene().wall(4.0F);
  const View with = DepthScene(empty).person({1, {0.0F, kCameraHeightM, 2.0F}}).look(camera);
  const View without = empty.look(camera);
  std::vector<PersonTrack> tracks{scene::track_of(with, 1, 1.0)};
  carry_people(camera, {without.depth_m, nothing_known(without), SE3(), 1.0 + kStepS, kStepS}, tracks);
  EXPECT_DOUBLE_EQ(tracks[0].seen_s, 1.0);
  EXPECT_LT(tracks[0].visible.size(), with.depth_m.total() / 100);
  EXPECT_EQ(tracks[0].shape.size(), scene::track_of(with, 1).shape.size());
}

TEST(PersonCarry, DoesNotSwallowFurniture) {
  // A desk he touches, a cupboard he passes, the floor.
  const Eigen::Vector3f velocity(0.5F, 0.0F, 0.0F);
  Walk walk(DepthScene()
                .wall(4.0F)
                .floor()
                .block({0.35F, 0.4F, 2.5F}, {1.3F, 1.2F, 3.0F})
                .block({-1.2F, -0.6F, 2.6F}, {-0.6F, 1.2F, 3.0F})
                .person(walker({-0.3F, kCameraHeightM, 2.8F}, velocity)));
  walk.add_noise(3);
  walk.follow(1, velocity);
  walk.steps(30);
  EXPECT_LT(walk.swallowed(1), 0.25);
}

TEST(PersonCarry, DoesNotSwallowFurnitureThatStandsBesideAStandingMan) {
  Walk walk(DepthScene()
                .wall(4.0F)
                .floor()
                .block({0.2F, 0.3F, 2.7F}, {1.3F, 1.2F, 3.0F})
                .person({1, {0.0F, kCameraHeightM, 2.8F}}),
            [](double t) { return scene::world_from_camera_at(0.2 * t, 0.0, 0.0); });
  walk.add_noise(4);
  walk.follow(1);
  walk.steps(30);
  EXPECT_LT(walk.swallowed(1), 0.2);
  EXPECT_GT(walk.iou(1), 0.7);
}

TEST(PersonCarry, KeepsPeopleApart) {
  const Eigen::Vector3f right(0.5F, 0.0F, 0.0F), left(-0.5F, 0.0F, 0.0F);
  Walk walk(DepthScene()
                .wall(5.0F)
                .floor()
                .person(walker({-0.5F, kCameraHeightM, 2.4F}, right))
                .person(walker({0.6F, kCameraHeightM, 3.4F}, left, 2)));
  walk.follow(1, right);
  walk.follow(2, left);
  for (int i = 0; i < 30; ++i) {
    walk.step();
    std::vector<int> a = walk.track(1).visible.cells, b = walk.track(2).visible.cells, both;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    ASSERT_TRUE(both.empty()) << i;
  }
  EXPECT_GT(walk.iou(1), 0.6);
}

/// Cells found of somebody at 2 m of whom only the legs were known, when his torso has just come into view
/// above them; changed: because something before it went away, not because the camera turned.
std::size_t cells_found_above_legs(bool changed, bool shown) {
  const GridCamera camera = scene::grid_camera();
  cv::Mat1f depth_m(camera.size(), 4.0F);
  const cv::Rect body(60, 40, 20, 60), legs(60, 80, 20, 20);
  depth_m(body).setTo(2.0F);
  StillSurface still = StillSurface::begin(depth_m);
  still.changed.setTo(changed ? 1 : 0);
  PersonTrack track;
  track.number = 1;
  track.shown = shown;
  for (int y = legs.y; y < legs.br().y; ++y) {
    for (int x = legs.x; x < legs.br().x; ++x) track.visible.add(y * 160 + x, 2.0F);
  }
  track.shape = track.visible;
  std::vector<PersonTrack> tracks{track};
  carry_people(camera, {depth_m, still, SE3(), 1.0, kStepS}, tracks);
  EXPECT_FALSE(tracks[0].shown) << "by this frame's boxes";
  return tracks[0].visible.size() - static_cast<std::size_t>(legs.area());
}

TEST(PersonCarry, FindsTheRestOfWhoComesOutFromBehindSomebody) {
  const std::size_t far = cells_found_above_legs(true, false);
  EXPECT_GE(far, 10U * 20U);
  EXPECT_LT(cells_found_above_legs(false, false), far / 2) << "the camera has turned to a desk beside him";
  EXPECT_LT(cells_found_above_legs(true, true), far / 2) << "the next box will say";
}

TEST(PersonCarry, NobodyIsNothingToCarry) {
  const GridCamera camera = scene::grid_camera();
  const View view = DepthScene().wall(4.0F).look(camera);
  std::vector<PersonTrack> tracks;
  carry_people(camera, {view.depth_m, nothing_known(view), SE3(), 0.1, 0.1}, tracks);
  EXPECT_TRUE(tracks.empty());
}

TEST(PersonCarry, SurvivesFramesWithoutDepthAndWithoutTime) {
  const GridCamera camera = scene::grid_camera();
  const View view = DepthScene().wall(4.0F).person({1, {0.0F, kCameraHeightM, 2.0F}}).look(camera);
  const cv::Mat1f none(camera.size(), 0.0F);
  std::vector<PersonTrack> tracks{scene::track_of(view, 1, 1.0)};
  carry_people(camera, {none, nothing_known(view), SE3(), 1.1, 0.1}, tracks);
  EXPECT_TRUE(tracks[0].visible.cells.empty());
  carry_people(camera, {view.depth_m, nothing_known(view), SE3(), 1.2, 0.1}, tracks);
  EXPECT_GT(scene::overlap(tracks[0].visible.cells, scene::cells_of(view, 1)), 0.8);
  EXPECT_DOUBLE_EQ(tracks[0].seen_s, 1.2);
  carry_people(camera, {view.depth_m, nothing_known(view), SE3(), 1.2, 0.0}, tracks);
  EXPECT_TRUE(tracks[0].velocity_m_per_s.allFinite());
}

}  // namespace
}  // namespace cpslam
