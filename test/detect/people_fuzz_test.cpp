#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "detect/depth_scene.h"
#include "detect/keypoint_filter.h"
#include "detect/person_mask.h"
#include "detect/person_tracks.h"
#include "support/synthetic.h"

// Whatever boxes and depths come in: nothing breaks, and nobody is seen where no box is.

namespace cpslam {
namespace {

constexpr double kStepS = 1.0 / 30.0;

double any_number(Random& random, double scale) {
  constexpr std::array<double, 8> kOdd{0.0,
                                       -1.0,
                                       1e-300,
                                       1e300,
                                       -1e300,
                                       std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity()};
  if (random.uniform() < 0.15) return kOdd.at(random.index(kOdd.size()));
  return random.uniform(-0.5, 1.5) * scale;
}

std::vector<PersonBox> any_boxes(Random& random) {
  std::vector<PersonBox> boxes;
  for (std::size_t n = random.index(7); n > 0; --n) {
    boxes.push_back({any_number(random, 640.0), any_number(random, 480.0), any_number(random, 300.0),
                     any_number(random, 300.0), any_number(random, 1.0)});
  }
  return boxes;
}

/// Nothing, noise, one depth everywhere, or a room with somebody in it, with holes.
cv::Mat1f any_depth(const GridCamera& camera, Random& random) {
  cv::Mat1f depth_m(camera.size(), 0.0F);
  switch (random.index(5)) {
    case 0:
      break;
    case 1:
      for (float& d : depth_m) d = float(random.uniform(0.2, 12.0));
      break;
    case 2:
      depth_m.setTo(float(random.uniform(0.01, 60.0)));
      break;
    default:
      depth_m = scene::DepthScene()
                    .wall(float(random.uniform(2.0, 6.0)))
                    .floor()
                    .person({1, {float(random.uniform(-1.0, 1.0)), 1.2F, float(random.uniform(0.8, 4.0))}})
                    .look(camera)
                    .depth_m;
  }
  const double holes = random.uniform() < 0.5 ? random.uniform(0.0, 0.7) : 0.0;
  for (float& d : depth_m) d = random.uniform() < holes ? 0.0F : d;
  return depth_m;
}

FlowKeypoints any_keypoints(const cv::Mat1f& depth_m, Random& random) {
  FlowKeypoints keypoints;
  for (int i = 0; i < 150; ++i) {
    const cv::Point at(int(random.index(640)), int(random.index(480)));
    const bool read = random.uniform() < 0.8;
    keypoints.keypoints.push_back({float(at.x), float(at.y), read ? depth_m(at.y / 4, at.x / 4) : 0.0F});
    keypoints.descriptors.push_back(synthetic::random_descriptor(random));
  }
  return keypoints;
}

/// Whether a keypoint lies within reach of a box.
bool near_box(const DepthKeypoint& k, const PersonBox& box) {
  constexpr double kReachPx = 40.0;
  const auto x = double(k.x), y = double(k.y);
  return x > box.x - kReachPx && y > box.y - kReachPx && x < box.x + box.width + kReachPx &&
         y < box.y + box.height + kReachPx;
}

void expect_sound(const PersonTracks& tracks) {
  const int n_cells = tracks.camera().n_cells();
  for (const PersonTrack& track : tracks.tracks()) {
    ASSERT_NE(track.number, 0);
    ASSERT_EQ(track.visible.cells.size(), track.visible.depth_m.size());
    ASSERT_EQ(track.shape.cells.size(), track.shape.depth_m.size());
    ASSERT_TRUE(track.velocity_m_per_s.allFinite());
    ASSERT_TRUE(std::isfinite(track.box.x) && std::isfinite(track.box.width));
    for (std::size_t i = 0; i < track.visible.size(); ++i) {
      ASSERT_GE(track.visible.cells[i], 0);
      ASSERT_LT(track.visible.cells[i], n_cells);
      ASSERT_GT(track.visible.depth_m[i], 0.0F);
    }
    for (const int cell : track.shape.cells) {
      ASSERT_GE(cell, 0);
      ASSERT_LT(cell, n_cells);
    }
  }
}

TEST(PeopleFuzz, KeypointsFarFromAllBoxesStay) {
  std::size_t removed = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Random random(seed);
    PersonTracks tracks(PinholeCamera(scene::camera_settings()), seed);
    const cv::Mat1f depth_m = any_depth(tracks.camera(), random);
    const FlowKeypoints keypoints = any_keypoints(depth_m, random);
    const std::vector<PersonBox> boxes = any_boxes(random);
    tracks.begin_frame(0, 10.0, depth_m, SE3());
    tracks.set_keypoints(keypoints);
    tracks.add_detections({0, 10.0, boxes});
    expect_sound(tracks);
    const auto marks =
        find_keypoints_on_people(tracks.camera(), depth_m, tracks.tracks(), 0.0, keypoints.keypoints);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const DepthKeypoint& k = keypoints.keypoints[i];
      removed += marks[i];
      if (std::none_of(boxes.begin(), boxes.end(), [&k](const PersonBox& box) { return near_box(k, box); })) {
        ASSERT_EQ(marks[i], 0) << "seed " << seed << ", keypoint at " << k.x << ' ' << k.y;
      }
    }
  }
  EXPECT_GT(removed, 100U) << "nothing was ever removed: the test shows nothing";
}

TEST(PeopleFuzz, AnySequenceOfFramesAndDetectionsIsSurvived) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed + 500);
    PersonTracks tracks(PinholeCamera(scene::camera_settings()), seed);
    double time_s = 10.0;
    for (std::uint64_t frame = 0; frame < 25; ++frame) {
      time_s += random.uniform() < 0.1 ? 3.0 * random.uniform() : kStepS;
      const SE3 motion(so3_exp(0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal())),
                       0.2 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
      const cv::Mat1f depth_m = any_depth(tracks.camera(), random);
      tracks.begin_frame(frame, time_s, depth_m, motion);
      if (random.uniform() < 0.9) tracks.set_keypoints(any_keypoints(depth_m, random));
      if (random.uniform() < 0.5) {
        const std::uint64_t of = frame - std::min<std::uint64_t>(frame, random.index(6));
        tracks.add_detections({of, time_s, any_boxes(random)});
      }
      tracks.end_frame(motion, random.uniform() < 0.8);
      expect_sound(tracks);
      cv::Mat raw(480, 640, CV_16UC1, cv::Scalar(0));
      if (random.uniform() < 0.5) cv::randu(raw, 0, 60000);
      const cv::Mat1b mask = person_mask(tracks.camera(), tracks.tracks(), raw, 1.0 / scene::kUnitsPerM);
      ASSERT_EQ(mask.size(), raw.size());
    }
  }
}

TEST(PeopleFuzz, OtherFiltersSurviveAnyBoxesToo) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed + 900);
    const std::vector<PersonBox> boxes = any_boxes(random);
    const FlowKeypoints keypoints =
        any_keypoints(cv::Mat1f(120, 160, float(random.uniform(0.5, 5.0))), random);
    const auto in_boxes = find_keypoints_in_boxes(boxes, keypoints.keypoints);
    const auto published = find_keypoints_as_published(boxes, keypoints.keypoints, random);
    for (std::size_t i = 0; i < published.size(); ++i) {
      if (published[i] != 0) {
        ASSERT_EQ(in_boxes[i], 1);
      }
    }
  }
}

}  // namespace
}  // namespace cpslam
