#pragma once

#include <string>

#include "cpslam/types.h"

namespace cpslam::program {

/// Writes trajectory into folder as NAME.txt and, as far as it is of other maps than `map`, as NAME_map2.txt
/// and so on by their numbers: a file is of one world. Such files of maps that are no more, left by another
/// run or written before a loop joined two maps, go. Throws RunError that names the file.
void write_by_map(const std::string& folder, const std::string& name, const Trajectory& trajectory, int map);

/// Removes what an earlier run, which may have dropped more maps, wrote as <name><digits>: .txt and
/// _map<digits>.txt.
void remove_dropped(const std::string& folder, const std::string& name);

/// Number of the map that has most of the poses; 1 without any.
[[nodiscard]] int map_with_most(const Trajectory& trajectory);

}  // namespace cpslam::program
