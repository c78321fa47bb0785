#pragma once

#include <string>

#include "cpslam/types.h"

namespace cpslam {

/// Writes "timestamp tx ty tz qx qy qz qw" lines (TUM format), through a temporary file that is renamed, so
/// that a full disk or a crash leaves either the old or the new file. Throws RunError naming the file.
void write_trajectory(const std::string& path, const Trajectory& trajectory);

/// Reads a TUM-format trajectory; '#' starts a comment, commas count as blanks. Throws InputError naming file
/// and line for a line that is not eight finite numbers, a quaternion of no length, or an unreadable file.
[[nodiscard]] Trajectory read_trajectory(const std::string& path);

}  // namespace cpslam
