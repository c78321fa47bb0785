#include <algorithm>
#include <map>
#include <utility>

#include "cpslam/trajectory.h"

namespace cpslam {

std::vector<Trajectory> split_by_map(const Trajectory& trajectory) {
  std::map<int, Trajectory> by_number;
  for (const StampedPose& pose : trajectory) by_number[pose.map].push_back(pose);
  std::vector<Trajectory> maps;
  maps.reserve(by_number.size());
  for (auto& [number, poses] : by_number) maps.push_back(std::move(poses));
  std::stable_sort(maps.begin(), maps.end(),
                   [](const Trajectory& a, const Trajectory& b) { return a.size() > b.size(); });
  return maps;
}

}  // namespace cpslam
