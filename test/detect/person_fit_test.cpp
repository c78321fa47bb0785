#include "detect/person_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "detect/depth_scene.h"
#include "detect/still_surface.h"

namespace cpslam {
namespace {

using scene::DepthScene;
using scene::kCameraHeightM;
using scene::Person;
using scene::View;

/// Fits boxes to what is seen; without more, nobody is known and nothing has stood still.
struct FitInput {
  const View& view;
  std::vector<KnownBox> boxes;
  cv::Mat1b people = scene::blank(view);
  cv::Mat1b still_age = scene::blank(view, StillSurface::kUnknownAge);
  std::vector<DepthKeypoint> keypoints = scene::keypoints_on(view);
  std::uint64_t seed = 1;

  [[nodiscard]] std::vector<PersonFit> fit() const {
    Random random(seed);
    const StillSurface still{view.depth_m, still_age, still_age, scene::blank(view)};
    return fit_people(scene::grid_camera(), {view.depth_m, people, still}, boxes, keypoints, random);
  }
};

PersonFit fit_one(const View& view, const PersonBox& box) {
  return FitInput{view, {{box}}}.fit().at(0);
}

double iou(const PersonFit& fit, const View& view, std::uint8_t number) {
  return scene::overlap(fit.cells, scene::cells_of(view, number));
}

int count_of(const PersonFit& fit, const View& view, std::uint8_t number) {
  return static_cast<int>(
      std::count_if(fit.cells.begin(), fit.cells.end(), [&](int c) { return view.owner(c) == number; }));
}

View look(const DepthScene& room) {
  return room.look(scene::grid_camera());
}

TEST(PersonFit, FindsAPersonBeforeAWall) {
  const View view = look(DepthScene().wall(4.0F).person({1, {0.2F, kCameraHeightM, 2.4F}}));
  const PersonFit fit = fit_one(view, scene::box_of(view, 1));
  ASSERT_TRUE(fit.model.valid());
  EXPECT_NEAR(fit.model.mean_m, 2.3F, 0.15F);
  EXPECT_GT(iou(fit, view, 1), 0.85);
  EXPECT_TRUE(std::is_sorted(fit.cells.begin(), fit.cells.end()));
}

TEST(PersonFit, FindsHimWhoStandsOnTheFloorAndLeavesTheFloor) {
  const View view = look(DepthScene().wall(5.0F).floor().person({1, {-0.3F, kCameraHeightM, 3.0F}}));
  const PersonFit fit = fit_one(view, scene::box_of(view, 1));
  EXPECT_GT(iou(fit, view, 1), 0.8);
  EXPECT_LT(count_of(fit, view, 0), int(fit.cells.size()) / 10);
}

TEST(PersonFit, DoesSoInNoiseToo) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    View view = look(DepthScene().wall(5.0F).floor().person({1, {-0.3F, kCameraHeightM, 3.0F}}));
    Random random(seed);
    scene::add_noise(view, random);
    FitInput input{view, {{scene::box_of(view, 1)}}};
    input.seed = seed;
    sum += iou(input.fit().at(0), view, 1);
  }
  EXPECT_GT(sum / 10.0, 0.75);
}

TEST(PersonFit, AMonitorBeforeHisLegsIsNotHis) {
  const Person person{1, {0.0F, kCameraHeightM, 2.4F}};
  const View whole = look(DepthScene().wall(4.5F).person(person));
  const View view =
      look(DepthScene().wall(4.5F).person(person).block({-0.3F, 0.25F, 1.3F}, {0.2F, 0.75F, 1.35F}));
  // The detector draws the box round all of him, what is hidden included.
  const PersonFit fit = fit_one(view, scene::box_of(whole, 1));
  EXPECT_GT(iou(fit, view, 1), 0.75);
  EXPECT_NEAR(fit.model.mean_m, 2.3F, 0.2F);
}

TEST(PersonFit, FindsWhoIsCutOffByTheImagesBorder) {
  const View view = look(DepthScene().wall(4.0F).floor().person({1, {-1.15F, kCameraHeightM, 2.0F}}));
  ASSERT_EQ(scene::box_of(view, 1).x, 0.0);
  EXPECT_GT(iou(fit_one(view, scene::box_of(view, 1)), view, 1), 0.75);
}

TEST(PersonFit, KeepsPeopleInOverlappingBoxesApart) {
  const View view = look(DepthScene()
                             .wall(5.0F)
                             .floor()
                             .person({1, {0.0F, kCameraHeightM, 1.8F}})
                             .person({2, {0.5F, kCameraHeightM, 3.0F}}));
  const std::vector<PersonFit> fits =
      FitInput{view, {{scene::box_of(view, 2)}, {scene::box_of(view, 1)}}}.fit();
  EXPECT_GT(iou(fits[0], view, 2), 0.7);
  EXPECT_GT(iou(fits[1], view, 1), 0.8);
  std::vector<int> both;
  std::set_intersection(fits[0].cells.begin(), fits[0].cells.end(), fits[1].cells.begin(),
                        fits[1].cells.end(), std::back_inserter(both));
  EXPECT_LT(both.size(), fits[0].cells.size() / 20);
}

TEST(PersonFit, WhoeverIsBeforeSomebodyIsNotHisArm) {
  // He has just come into the image, very near and cut off, before somebody whose box he is in.
  const View view = DepthScene()
                        .wall(4.0F)
                        .floor()
                        .person({1, {0.6F, kCameraHeightM, 1.5F}})
                        .person({2, {0.75F, kCameraHeightM, 0.9F}})
                        .look(scene::grid_camera());
  FitInput input{view, {{scene::box_of(view, 1)}, {scene::box_of(view, 2)}}};
  input.boxes[0].box.width = 640.0 - input.boxes[0].box.x;
  input.still_age.setTo(0, view.owner != 0);
  const std::vector<PersonFit> fits = input.fit();
  EXPECT_GT(iou(fits[0], view, 1), 0.7);
  EXPECT_GT(iou(fits[1], view, 2), 0.7);
  EXPECT_LT(count_of(fits[0], view, 2), count_of(fits[1], view, 2) / 10);
}

TEST(PersonFit, ABoxWithoutDepthHasNoModel) {
  const View view = look(DepthScene());
  const PersonFit fit = fit_one(view, {100.0, 100.0, 120.0, 300.0, 0.9});
  EXPECT_FALSE(fit.model.valid());
  EXPECT_TRUE(fit.cells.empty());
}

TEST(PersonFit, ABoxOutsideTheImageHasNoModel) {
  const View view = look(DepthScene().wall(3.0F));
  for (const PersonBox& box : {PersonBox{700.0, 10.0, 50.0, 50.0}, PersonBox{-90.0, 10.0, 50.0, 50.0},
                               PersonBox{10.0, 900.0, 50.0, 50.0}}) {
    const PersonFit fit = fit_one(view, box);
    EXPECT_FALSE(fit.model.valid());
    EXPECT_TRUE(fit.cells.empty());
  }
}

TEST(PersonFit, FindsWhoLeansOnTheWall) {
  const View view = look(DepthScene().wall(2.9F).floor().person({1, {0.2F, kCameraHeightM, 2.75F}}));
  const PersonFit fit = fit_one(view, scene::box_of(view, 1));
  EXPECT_GT(iou(fit, view, 1), 0.6);
  EXPECT_LT(count_of(fit, view, 0), int(fit.cells.size()) / 5);
}

TEST(PersonFit, KeypointsWithoutASurfaceAroundThemMakeNoPerson) {
  View view = look(DepthScene().wall(4.0F).person({1, {0.0F, kCameraHeightM, 2.4F}}));
  FitInput input{view, {{scene::box_of(view, 1)}}};
  view.depth_m.setTo(0.0F);
  EXPECT_TRUE(input.fit().at(0).cells.empty());
}

TEST(PersonFit, WhatStandsStillYieldsToWhatDoesNot) {
  // Half the box each: a cupboard nearer than the person, and as tall.
  const DepthScene room = DepthScene()
                              .wall(5.0F)
                              .person({1, {0.15F, kCameraHeightM, 2.8F}})
                              .block({-0.35F, -0.5F, 2.0F}, {-0.06F, 1.2F, 2.2F});
  const View view = look(room);
  PersonBox box = scene::box_of(view, 1);
  box.width += box.x - 230.0;
  box.x = 230.0;
  FitInput input{view, {{box}}};
  input.still_age.setTo(100);
  input.still_age.setTo(2, view.owner == 1);
  EXPECT_GT(iou(input.fit().at(0), view, 1), 0.75);
}

TEST(PersonFit, WhoIsExpectedInABoxIsPreferred) {
  // Two alike side by side in one box: the one who was carried into the frame is meant.
  const View view = look(DepthScene()
                             .wall(5.0F)
                             .person({1, {-0.3F, kCameraHeightM, 2.2F}})
                             .person({2, {0.35F, kCameraHeightM, 2.9F}}));
  const PersonBox first = scene::box_of(view, 1);
  const PersonBox second = scene::box_of(view, 2);
  const PersonBox both{first.x, std::min(first.y, second.y), second.x + second.width - first.x, 380.0, 0.9};
  for (const std::uint8_t number : {std::uint8_t{1}, std::uint8_t{2}}) {
    FitInput input{view, {{both, number}}};
    input.people = view.owner.clone();
    const PersonFit fit = input.fit().at(0);
    EXPECT_GT(count_of(fit, view, number), int(scene::cells_of(view, number).size()) * 6 / 10) << int(number);
  }
}

TEST(PersonFit, HoldsOutInRandomRoomsWithRandomBoxes) {
  constexpr int kTrials = 60;
  double sum = 0.0;
  int good = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(std::uint64_t(trial) + 77);
    const auto z_m = float(random.uniform(1.6, 3.6));
    const float x_m = z_m * float(random.uniform(-0.45, 0.45));
    View view = look(DepthScene()
                         .wall(z_m + float(random.uniform(0.7, 3.0)))
                         .floor()
                         .block({x_m + 0.5F, 0.45F, z_m - 0.6F}, {x_m + 1.4F, 1.2F, z_m + 0.2F})
                         .person({1, {x_m, kCameraHeightM, z_m}}));
    scene::add_noise(view, random);
    PersonBox box = scene::box_of(view, 1);
    box.x += 0.07 * box.width * random.normal();
    box.y += 0.05 * box.height * random.normal();
    box.width *= 1.0 + 0.07 * random.normal();
    box.height *= 1.0 + 0.05 * random.normal();
    FitInput input{view, {{box}}};
    input.seed = std::uint64_t(trial);
    const double found = iou(input.fit().at(0), view, 1);
    sum += found;
    good += found > 0.6 ? 1 : 0;
  }
  EXPECT_GT(sum / kTrials, 0.7);
  EXPECT_GE(good, kTrials * 8 / 10);
}

TEST(PersonFit, IsTheSameForTheSameSeed) {
  const View view = look(DepthScene().wall(4.0F).floor().person({1, {0.2F, kCameraHeightM, 2.4F}}));
  const FitInput input{view, {{scene::box_of(view, 1)}}};
  EXPECT_EQ(input.fit().at(0).cells, input.fit().at(0).cells);
}

TEST(CellsOfBox, CoverTheBox) {
  const GridCamera camera = scene::grid_camera();
  EXPECT_EQ(cells_of_box(camera, {8.0, 16.0, 40.0, 80.0}), cv::Rect(2, 4, 10, 20));
  EXPECT_EQ(cells_of_box(camera, {9.0, 17.0, 1.0, 1.0}).size(), cv::Size(1, 1));
  EXPECT_EQ(cells_of_box(camera, {-1e9, -1e9, 2e9, 2e9}), cv::Rect(0, 0, 160, 120));
  EXPECT_TRUE(cells_of_box(camera, {640.0, 0.0, 10.0, 10.0}).empty());
}

TEST(CellsOfBox, AreNoneForWhatIsNoBox) {
  const GridCamera camera = scene::grid_camera();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const PersonBox& box : {PersonBox{kNaN, 10.0, 50.0, 50.0}, PersonBox{10.0, kNaN, 50.0, 50.0},
                               PersonBox{10.0, 10.0, kNaN, 50.0}, PersonBox{10.0, 10.0, 50.0, kNaN},
                               PersonBox{-kInf, 10.0, kInf, 50.0}, PersonBox{50.0, 50.0, -20.0, 20.0},
                               PersonBox{50.0, 50.0, -1.0, 20.0}, PersonBox{50.0, 50.0, 20.0, 0.0}})
    EXPECT_TRUE(cells_of_box(camera, box).empty()) << box.x << ' ' << box.width;
}

}  // namespace
}  // namespace cpslam
