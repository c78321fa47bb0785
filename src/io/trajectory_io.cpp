#include "io/trajectory_io.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "io/atomic_file.h"
#include "io/text_table.h"

namespace cpslam {

void write_trajectory(const std::string& path, const Trajectory& trajectory) {
  std::string text;
  std::array<char, 400> line{};  // room for eight numbers of any size a pose can sensibly have
  for (const StampedPose& pose : trajectory) {
    const auto& t = pose.world_from_camera.translation_m;
    const auto& q = pose.world_from_camera.rotation_xyzw;
    std::snprintf(line.data(), line.size(), "%.6f %.7f %.7f %.7f %.7f %.7f %.7f %.7f\n", pose.time_s, t[0],
                  t[1], t[2], q[0], q[1], q[2], q[3]);
    text += line.data();
  }
  write_file_atomically(path, text);
}

Trajectory read_trajectory(const std::string& path) {
  TextTable table(path);
  Trajectory trajectory;
  while (table.next_row()) {
    table.expect_fields(8, "timestamp tx ty tz qx qy qz qw");
    StampedPose pose;
    pose.time_s = table.number(0);
    auto& t = pose.world_from_camera.translation_m;
    auto& q = pose.world_from_camera.rotation_xyzw;
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = table.number(1 + i);
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = table.number(4 + i);
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(length > 1e-6 && length < 1e6)) table.fail("the quaternion has no sensible length");
    for (double& component : q) component /= length;
    trajectory.push_back(pose);
  }
  return trajectory;
}

}  // namespace cpslam
