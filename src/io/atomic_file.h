#pragma once

#include <string>
#include <string_view>

namespace cpslam {

/// How far a written file has come when the call returns.
enum class Durability {
  kWritten,  ///< the system has it: outlives this program
  kOnDisk,   ///< the disk has it: outlives a power failure, too, and takes its time
};

/// Writes a whole file through a temporary one beside it ("<path>.partial") that is renamed, so that a full
/// disk or a crash (with kOnDisk also of the machine) leaves either the old or the new file. What exists and
/// is no regular file (a device, a pipe) is written to directly, a symbolic link stays one. Throws RunError
/// naming the file and the cause.
void write_file_atomically(const std::string& path, std::string_view content,
                           Durability durability = Durability::kWritten);

}  // namespace cpslam
