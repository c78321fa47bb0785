#pragma once

#include <gtest/gtest.h>

#include "cpslam/types.h"

namespace cpslam::test {

/// Equal bit by bit.
inline void expect_same(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].time_s, b[i].time_s);
    ASSERT_EQ(a[i].world_from_camera.rotation_xyzw, b[i].world_from_camera.rotation_xyzw) << i;
    ASSERT_EQ(a[i].world_from_camera.translation_m, b[i].world_from_camera.translation_m) << i;
  }
}

}  // namespace cpslam::test
