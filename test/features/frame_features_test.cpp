#include "features/frame_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cpslam/error.h"
#include "support/tum_cameras.h"
#include "test_images.h"

namespace cpslam {
namespace {

/// Depth in 1/5000 m: a wall, nearer to the right, with a hole.
cv::Mat wall_depth() {
  cv::Mat depth(480, 640, CV_16UC1);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(15000 - 5 * x);
  }
  depth(cv::Rect(100, 100, 200, 100)).setTo(0);
  return depth;
}

TEST(FrameFeatures, HoldsWhatTheImagesSay) {
  const CameraSettings settings = tum1_camera();
  const PinholeCamera camera(settings);
  const cv::Mat grey = test::textured_image(640, 480, 1);
  const cv::Mat depth = wall_depth();
  const auto features = FrameFeaturesBuilder(settings, {}).build(grey, depth);
  OrbFeatures found;
  OrbExtractor(OrbSettings{}).extract(grey, found);

  ASSERT_EQ(features->size(), static_cast<int>(found.keypoints.size()));
  ASSERT_EQ(features->depth_m.size(), found.keypoints.size());
  EXPECT_EQ(features->descriptors, found.descriptors);
  int n_without = 0;
  for (std::size_t i = 0; i < found.keypoints.size(); ++i) {
    const OrbKeypoint& k = found.keypoints[i];
    const Keypoint& u = features->keypoints[i];
    const Eigen::Vector2d back = camera.distort({static_cast<double>(u.x), static_cast<double>(u.y)});
    EXPECT_NEAR(back.x(), static_cast<double>(k.x), 1e-3);
    EXPECT_NEAR(back.y(), static_cast<double>(k.y), 1e-3);
    EXPECT_EQ(u.octave, k.octave);
    EXPECT_EQ(u.angle_deg, k.angle_deg);
    const std::uint16_t raw =
        depth.at<std::uint16_t>(static_cast<int>(std::lround(k.y)), static_cast<int>(std::lround(k.x)));
    if (features->depth_m[i] == 0.0F) {
      ++n_without;
      EXPECT_EQ(raw, 0);
      EXPECT_EQ(features->disparity_px[i], 0.0F);
      EXPECT_EQ(features->depth_sigma_m[i], 0.0F);
      continue;
    }
    if (raw != 0) {
      EXPECT_FLOAT_EQ(features->depth_m[i], static_cast<float>(raw / 5000.0));
    }
    EXPECT_FLOAT_EQ(features->disparity_px[i], 40.0F / features->depth_m[i]);
    EXPECT_GT(features->depth_sigma_m[i], 0.001F);
    EXPECT_LT(features->depth_sigma_m[i], 0.05F);
  }
  EXPECT_GT(n_without, 10);
  EXPECT_LT(n_without, 300);
  std::vector<int> all;
  features->grid.query(320.0F, 240.0F, 1000.0F, 0, 7, all);
  EXPECT_EQ(all.size(), found.keypoints.size());
}

TEST(FrameFeatures, FloatAndIntegerDepthAgree) {
  const cv::Mat grey = test::textured_image(640, 480, 2);
  const cv::Mat depth = wall_depth();
  cv::Mat as_float;
  depth.convertTo(as_float, CV_32FC1);
  FrameFeaturesBuilder builder(tum1_camera(), {});
  const auto a = builder.build(grey, depth);
  const auto b = builder.build(grey, as_float);
  EXPECT_EQ(a->depth_m, b->depth_m);
  EXPECT_EQ(a->depth_sigma_m, b->depth_sigma_m);
  EXPECT_EQ(a->descriptors, b->descriptors) << "the builder's memory leaked from one frame into the next";
}

void expect_equal(const FrameFeatures& a, int i, const FrameFeatures& b, int j) {
  const auto ia = static_cast<std::size_t>(i);
  const auto jb = static_cast<std::size_t>(j);
  EXPECT_EQ(a.keypoints[ia].x, b.keypoints[jb].x);
  EXPECT_EQ(a.keypoints[ia].y, b.keypoints[jb].y);
  EXPECT_EQ(a.keypoints[ia].angle_deg, b.keypoints[jb].angle_deg);
  EXPECT_EQ(a.keypoints[ia].response, b.keypoints[jb].response);
  EXPECT_EQ(a.keypoints[ia].octave, b.keypoints[jb].octave);
  EXPECT_EQ(a.descriptors[ia], b.descriptors[jb]);
  EXPECT_EQ(a.depth_m[ia], b.depth_m[jb]);
  EXPECT_EQ(a.disparity_px[ia], b.disparity_px[jb]);
  EXPECT_EQ(a.depth_sigma_m[ia], b.depth_sigma_m[jb]);
}

/// The camera goes forward and sideways between colour and depth.
SE3 small_motion() {
  return {Eigen::Quaterniond::Identity(), {0.03, 0.0, -0.02}};
}

TEST(FrameFeatures, TwoStepsKeepingAllAreOneStep) {
  const cv::Mat grey = test::textured_image(640, 480, 3);
  const cv::Mat depth = wall_depth();
  const auto whole = FrameFeaturesBuilder(tum1_camera(), {}).build(grey, depth, small_motion());
  FrameFeaturesBuilder builder(tum1_camera(), {});
  const KeypointCandidates& candidates = builder.extract(grey, depth, small_motion());
  ASSERT_EQ(candidates.depth.size(), candidates.orb.keypoints.size());
  ASSERT_EQ(candidates.undistorted.size(), candidates.orb.keypoints.size());
  const std::vector<std::uint8_t> all(static_cast<std::size_t>(candidates.size()), 1);
  const auto split = builder.finish(candidates, all);
  ASSERT_EQ(split->size(), whole->size());
  for (int i = 0; i < whole->size(); ++i) expect_equal(*split, i, *whole, i);
  std::vector<int> found_split;
  std::vector<int> found_whole;
  split->grid.query(300.0F, 200.0F, 50.0F, 0, 7, found_split);
  whole->grid.query(300.0F, 200.0F, 50.0F, 0, 7, found_whole);
  EXPECT_EQ(found_split, found_whole);
  EXPECT_FALSE(found_whole.empty());
}

TEST(FrameFeatures, OnlyTheKeptAreInTheFrame) {
  const cv::Mat grey = test::textured_image(640, 480, 4);
  const cv::Mat depth = wall_depth();
  FrameFeaturesBuilder builder(tum1_camera(), {});
  const auto whole = builder.build(grey, depth);
  const KeypointCandidates& candidates = builder.extract(grey, depth);
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(candidates.size()));
  std::vector<int> kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = i % 3 == 1 ? 1 : 0;
    if (keep[i] != 0) kept.push_back(static_cast<int>(i));
  }
  const auto some = builder.finish(candidates, keep);
  ASSERT_EQ(some->size(), static_cast<int>(kept.size()));
  for (int i = 0; i < some->size(); ++i) expect_equal(*some, i, *whole, kept[static_cast<std::size_t>(i)]);
  std::vector<int> found;
  some->grid.query(320.0F, 240.0F, 1000.0F, 0, 7, found);
  EXPECT_EQ(found.size(), kept.size());
  EXPECT_EQ(builder.finish(candidates, std::vector<std::uint8_t>(keep.size(), 0))->size(), 0);
  keep.pop_back();
  EXPECT_THROW((void)builder.finish(candidates, keep), InputError);
}

TEST(FrameFeatures, ExtendedCandidatesCarryDepthAndUndistortedPixels) {
  const PinholeCamera camera(tum1_camera());
  const cv::Mat grey = test::textured_image(640, 480, 5);
  const cv::Mat depth = wall_depth();
  cv::Mat people = cv::Mat::zeros(120, 160, CV_8UC1);
  people.colRange(0, 110).setTo(1);
  FrameFeaturesBuilder builder(tum1_camera(), {});
  KeypointCandidates& candidates = builder.extract(grey, depth, {}, {.people = people});
  const int n = candidates.size();
  EXPECT_EQ(n, 1150);
  EXPECT_EQ(builder.extend(candidates, people, 200), 200);
  ASSERT_EQ(candidates.size(), n + 200);
  ASSERT_EQ(candidates.depth.size(), candidates.undistorted.size());
  ASSERT_EQ(candidates.orb.descriptors.size(), candidates.undistorted.size());
  for (int i = n; i < candidates.size(); ++i) {
    const OrbKeypoint& k = candidates.orb.keypoints[static_cast<std::size_t>(i)];
    const Keypoint& u = candidates.undistorted[static_cast<std::size_t>(i)];
    const Eigen::Vector2d back = camera.distort({static_cast<double>(u.x), static_cast<double>(u.y)});
    EXPECT_NEAR(back.x(), static_cast<double>(k.x), 1e-3);
    EXPECT_NEAR(back.y(), static_cast<double>(k.y), 1e-3);
    EXPECT_EQ(u.octave, k.octave);
    const DepthReading expected = read_keypoint_depth(depth, 1.0 / 5000.0, static_cast<int>(std::lround(k.x)),
                                                      static_cast<int>(std::lround(k.y)));
    EXPECT_EQ(candidates.depth[static_cast<std::size_t>(i)].depth_m, expected.depth_m);
    EXPECT_GE(k.x, 439.0F);
  }
}

TEST(FrameFeatures, AFrameWithoutAnythingIsEmpty) {
  FrameFeaturesBuilder builder(tum1_camera(), {});
  const auto features = builder.build(cv::Mat::zeros(480, 640, CV_8UC1), cv::Mat::zeros(480, 640, CV_16UC1));
  EXPECT_EQ(features->size(), 0);
  std::vector<int> found;
  features->grid.query(320.0F, 240.0F, 1000.0F, 0, 7, found);
  EXPECT_TRUE(found.empty());
}

TEST(FrameFeatures, RefusesImagesThatDoNotFit) {
  FrameFeaturesBuilder builder(tum1_camera(), {});
  const cv::Mat grey = cv::Mat::zeros(480, 640, CV_8UC1);
  EXPECT_THROW((void)builder.build(grey, cv::Mat::zeros(240, 320, CV_16UC1)), InputError);
  EXPECT_THROW((void)builder.build(grey, cv::Mat::zeros(480, 640, CV_8UC1)), InputError);
  EXPECT_THROW((void)builder.build(grey, cv::Mat()), InputError);
  EXPECT_THROW((void)builder.build(cv::Mat::zeros(240, 320, CV_8UC1), cv::Mat::zeros(240, 320, CV_16UC1)),
               InputError);
  EXPECT_THROW((void)builder.build(cv::Mat::zeros(480, 640, CV_8UC3), cv::Mat::zeros(480, 640, CV_16UC1)),
               InputError);
}

}  // namespace
}  // namespace cpslam
