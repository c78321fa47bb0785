#include "common/trajectory_files.h"

#include <filesystem>
#include <regex>
#include <set>

#include "common/output_folder.h"
#include "cpslam/error.h"
#include "cpslam/trajectory.h"
#include "io/trajectory_io.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

void remove_others(const std::string& folder, const std::string& name, const std::set<fs::path>& written) {
  for (const fs::path& path : find_files(folder, std::regex(name + "_map[0-9]+\\.txt"))) {
    std::error_code error;
    if (!written.contains(path) && !fs::remove(path, error))
      throw RunError("'" + path.string() + "' is of another run and stays there");
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
  remove_others(folder, name, written);
}

void remove_dropped(const std::string& folder, const std::string& name) {
  std::error_code ignored;
  for (const fs::path& path : find_files(folder, std::regex(name + "[0-9]+(_map[0-9]+)?\\.txt")))
    fs::remove(path, ignored);
}

int map_with_most(const Trajectory& trajectory) {
  return trajectory.empty() ? 1 : split_by_map(trajectory).front().front().map;
}

}  // namespace cpslam::program
