#include "common/trajectory_files.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <vector>

#include "cpslam/error.h"
#include "cpslam/trajectory.h"
#include "io/trajectory_io.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

/// NAME_map and a number and .txt.
bool is_of_a_map(std::string_view file, const std::string& name) {
  const std::string begin = name + "_map";
  constexpr std::string_view kEnd = ".txt";
  if (!file.starts_with(begin) || !file.ends_with(kEnd) || file.size() <= begin.size() + kEnd.size())
    return false;
  const std::string_view number = file.substr(begin.size(), file.size() - begin.size() - kEnd.size());
  return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

void remove_others(const fs::path& folder, const std::string& name, const std::set<fs::path>& written) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (is_of_a_map(path.filename().string(), name) && !written.contains(path)) old.push_back(path);
  }
  for (const fs::path& path : old) {
    if (!fs::remove(path, error)) throw RunError("'" + path.string() + "' is of another run and stays there");
  }
}

}  // namespace

void write_by_map(const std::string& folder, const std::string& name, const Trajectory& trajectory, int map) {
  const fs::path dir = folder;
  Trajectory of_map;
  std::set<fs::path> written;
  for (const Trajectory& poses : split_by_map(trajectory)) {
    const int number = poses.front().map;
    if (number == map) {
      of_map = poses;
      continue;
    }
    const fs::path path = dir / (name + "_map" + std::to_string(number) + ".txt");
    write_trajectory(path.string(), poses);
    written.insert(path);
  }
  write_trajectory((dir / (name + ".txt")).string(), of_map);
  remove_others(dir, name, written);
}

int map_with_most(const Trajectory& trajectory) {
  return trajectory.empty() ? 1 : split_by_map(trajectory).front().front().map;
}

}  // namespace cpslam::program
