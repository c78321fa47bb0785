#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "sim/body.h"
#include "sim/simulation.h"

namespace cpslam::sim {
namespace {

SimulationOptions options_of(const std::string& preset, int n_people, std::uint64_t seed = 1) {
  SimulationOptions options;
  options.preset = preset;
  options.n_people = n_people;
  options.seed = seed;
  return options;
}

TEST(SimulatedPeople, MaskIsExactlyWherePeopleChangeTheDepth) {
  Simulation crowd(options_of("walking_xyz", 4));
  Simulation empty(options_of("walking_xyz", 0));
  int n_person = 0;
  for (const int index : {20, 100, 180}) {
    const SimulatedFrame with = crowd.render(index);
    const SimulatedFrame without = empty.render(index);
    ASSERT_EQ(cv::countNonZero(without.person_mask), 0);
    EXPECT_TRUE(without.people.empty());
    for (int y = 0; y < with.depth.rows; ++y) {
      for (int x = 0; x < with.depth.cols; ++x) {
        const std::uint16_t a = with.depth.at<std::uint16_t>(y, x);
        const std::uint16_t b = without.depth.at<std::uint16_t>(y, x);
        if (with.person_mask.at<std::uint8_t>(y, x) == 0) {
          ASSERT_EQ(a, b) << x << ", " << y;
        } else {
          ++n_person;
          ASSERT_LE(a, b) << x << ", " << y;
        }
      }
    }
  }
  EXPECT_GT(n_person, 20000);
}

TEST(SimulatedPeople, BoxesAreTightAroundMasksAndTinyRestsHaveNone) {
  Simulation simulation(options_of("walking_rpy", 6));
  std::size_t fewest = 99, most = 0;
  for (int index = 0; index < 600; index += 60) {
    const SimulatedFrame frame = simulation.render(index);
    std::map<int, cv::Rect> rest;
    for (int id = 0; id < 6; ++id) {
      const cv::Rect extent = cv::boundingRect(frame.person_mask == id + 1);
      if (!extent.empty()) rest[id] = extent;
    }
    for (const SimulatedPerson& person : frame.people) {
      ASSERT_TRUE(rest.count(person.id));
      const cv::Rect& extent = rest[person.id];
      EXPECT_EQ(person.box.x, extent.x);
      EXPECT_EQ(person.box.y, extent.y);
      EXPECT_EQ(person.box.width, extent.width);
      EXPECT_EQ(person.box.height, extent.height);
      EXPECT_GE(person.visible_share, 0.02);
      rest.erase(person.id);
    }
    for (const auto& [id, extent] : rest) {
      const int n = cv::countNonZero(frame.person_mask == id + 1);
      EXPECT_LT(n, 0.02 * 640 * 480) << "person " << id << " of frame " << index << " has no box";
    }
    EXPECT_EQ(frame.boxes().size(), frame.people.size());
    fewest = std::min(fewest, frame.people.size());
    most = std::max(most, frame.people.size());
  }
  EXPECT_LT(fewest, most) << "people walk in and out of the image";
  EXPECT_GE(most, 3U);
}

TEST(SimulatedPeople, AStrideSpansHalfAMetreAndFeetStayOnTheFloor) {
  const Simulation simulation(options_of("walking_static", 3));
  for (int person = 0; person < 3; ++person) {
    double longest_m = 0.0;
    for (int i = 0; i < simulation.size(); ++i) {
      const auto joints = simulation.person_joints(person, i);
      const Eigen::Vector3d between = joints[kToesLeft] - joints[kToesRight];
      longest_m = std::max(longest_m, between.head<2>().norm());
      const double lower_m = std::min(joints[kToesLeft].z(), joints[kToesRight].z());
      EXPECT_GT(lower_m, 0.0);
      EXPECT_LT(lower_m, 0.12);
    }
    EXPECT_GT(longest_m, 0.5) << person;
    EXPECT_LT(longest_m, 1.0) << person;
  }
}

TEST(SimulatedPeople, ABodySpansHalfAMetreOfDepthInTheImage) {
  Simulation simulation(options_of("walking_static", 3));
  double deepest_m = 0.0;
  for (int index = 0; index < 400; index += 20) {
    const SimulatedFrame frame = simulation.render(index);
    for (const SimulatedPerson& person : frame.people) {
      double nearest = 0.0, farthest = 0.0;
      cv::minMaxLoc(frame.depth, &nearest, &farthest, nullptr, nullptr, frame.person_mask == person.id + 1);
      deepest_m = std::max(deepest_m, (farthest - nearest) / 5000.0);
    }
  }
  EXPECT_GT(deepest_m, 0.5);
}

TEST(SimulatedPeople, WalkAtWalkingSpeedInsideTheRooms) {
  for (const char* preset : {"walking_static", "walking_halfsphere", "ring_walking"}) {
    const Simulation simulation(options_of(preset, SimulationOptions::kMaxPeople));
    for (int person = 0; person < simulation.n_people(); ++person) {
      double travelled_m = 0.0;
      Eigen::Vector3d last = simulation.person_joints(person, 0)[kNeck];
      for (int i = 1; i < simulation.size(); ++i) {
        const auto joints = simulation.person_joints(person, i);
        const double step_m = (joints[kNeck] - last).norm();
        travelled_m += step_m;
        ASSERT_LT(step_m * 30.0, 2.2) << preset << " person " << person << " frame " << i;
        last = joints[kNeck];
        for (const Eigen::Vector3d& joint : joints) {
          const bool inside =
              std::any_of(simulation.rooms().begin(), simulation.rooms().end(),
                          [&](const auto& room) { return room.contains(joint.cast<float>()); });
          ASSERT_TRUE(inside) << preset << " person " << person << " frame " << i << " at "
                              << joint.transpose();
        }
      }
      EXPECT_GT(travelled_m, 4.0) << preset << " person " << person;
    }
  }
}

TEST(SimulatedPeople, NobodyRunsIntoTheCamera) {
  for (const char* preset : {"walking_xyz", "walking_halfsphere", "ring_walking", "sitting_halfsphere"}) {
    const Simulation simulation(options_of(preset, SimulationOptions::kMaxPeople, 7));
    double nearest_m = 1e9;
    for (int i = 0; i < simulation.size(); i += 2) {
      const Eigen::Vector3d camera = simulation.world_from_camera(i).translation;
      for (int person = 0; person < simulation.n_people(); ++person)
        for (const Eigen::Vector3d& joint : simulation.person_joints(person, i))
          nearest_m = std::min(nearest_m, (joint - camera).norm());
    }
    EXPECT_GT(nearest_m, 0.3) << preset;
  }
}

TEST(SimulatedPeople, SittingPeopleStayAndHaveTheirHandsOnTheDesk) {
  const Simulation simulation(options_of("sitting_static", 4));
  for (int person = 0; person < 4; ++person) {
    const Eigen::Vector3d first = simulation.person_joints(person, 0)[kHipLeft];
    double lowest_hand_m = 1e9, moved_m = 0.0;
    for (int i = 0; i < simulation.size(); i += 3) {
      const auto joints = simulation.person_joints(person, i);
      EXPECT_LT((joints[kHipLeft] - first).norm(), 0.05);
      EXPECT_LT(joints[kHead].z(), 1.45);
      lowest_hand_m = std::min(lowest_hand_m, joints[kWristLeft].z());
      moved_m =
          std::max(moved_m, (joints[kWristRight] - simulation.person_joints(person, 0)[kWristRight]).norm());
    }
    EXPECT_NEAR(lowest_hand_m, 0.78, 0.05) << person;
    EXPECT_GT(moved_m, 0.15) << "person " << person << " never gestures";
  }
}

}  // namespace
}  // namespace cpslam::sim
