#pragma once

#include <gtest/gtest.h>

#include "map/map_parts.h"

namespace cpslam::test {

inline void expect_same(const SE3& a, const SE3& b) {
  EXPECT_EQ(a.rotation, b.rotation);
  EXPECT_EQ(a.translation, b.translation);
}

inline void expect_same(const FrameFeatures& a, const FrameFeatures& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const Keypoint& k = a.keypoints[i];
    const Keypoint& l = b.keypoints[i];
    EXPECT_TRUE(k.x == l.x && k.y == l.y && k.angle_deg == l.angle_deg && k.response == l.response &&
                k.octave == l.octave);
  }
  EXPECT_EQ(a.descriptors, b.descriptors);
  EXPECT_EQ(a.depth_m, b.depth_m);
  EXPECT_EQ(a.disparity_px, b.disparity_px);
  EXPECT_EQ(a.depth_sigma_m, b.depth_sigma_m);
}

inline void expect_same(const MapParts::PointPart& a, const MapParts::PointPart& b) {
  EXPECT_EQ(a.position_in_world, b.position_in_world);
  ASSERT_EQ(a.observations.size(), b.observations.size());
  for (std::size_t i = 0; i < a.observations.size(); ++i) {
    EXPECT_EQ(a.observations[i].keyframe, b.observations[i].keyframe);
    EXPECT_EQ(a.observations[i].keypoint, b.observations[i].keypoint);
  }
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.first_sequence, b.first_sequence);
  EXPECT_EQ(a.visible, b.visible);
  EXPECT_EQ(a.found, b.found);
}

/// To the bit.
inline void expect_same(const MapParts& a, const MapParts& b) {
  ASSERT_EQ(a.keyframes.size(), b.keyframes.size());
  for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
    EXPECT_EQ(a.keyframes[i].sequence, b.keyframes[i].sequence);
    EXPECT_EQ(a.keyframes[i].time_s, b.keyframes[i].time_s);
    EXPECT_EQ(a.keyframes[i].parent, b.keyframes[i].parent);
    expect_same(a.keyframes[i].cam_from_world, b.keyframes[i].cam_from_world);
    expect_same(*a.keyframes[i].features, *b.keyframes[i].features);
  }
  EXPECT_EQ(a.loops, b.loops);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) expect_same(a.points[i], b.points[i]);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].time_s, b.frames[i].time_s);
    EXPECT_EQ(a.frames[i].keyframe, b.frames[i].keyframe);
    expect_same(a.frames[i].cam_from_keyframe, b.frames[i].cam_from_keyframe);
  }
  EXPECT_EQ(a.keyframes_created, b.keyframes_created);
  EXPECT_EQ(a.points_created, b.points_created);
}

}  // namespace cpslam::test
