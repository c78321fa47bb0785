#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cpslam::program {

/// A picture to look at.
struct Picture {
  std::string key;   ///< what its boxes are listed under: its path as the source has it, or its time stamp
  std::string path;  ///< ready to open
  std::optional<double> time_s{};  ///< of a sequence's
};

/// The pictures of: a TUM-format sequence (a folder with rgb.txt; keys are stamps), any other folder, a list
/// (a text file, one path a line relative to its folder), or a single picture. Throws InputError naming the
/// source, or the list's line.
[[nodiscard]] std::vector<Picture> find_pictures(const std::string& source);

}  // namespace cpslam::program
