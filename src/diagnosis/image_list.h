#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "diagnosis/finding.h"

namespace cpslam::diagnosis {

/// A rgb.txt or depth.txt as it stands, whatever is wrong with it.
struct ImageList {
  std::string name;            ///< "rgb.txt"
  std::string error;           ///< the file cannot be read at all
  std::vector<double> stamps;  ///< s, in the file's order
  std::vector<std::string> paths;
  std::size_t n_bad_lines = 0;
  std::string first_bad_line;  ///< "file:line: what"
};

/// Never throws for what is in the file.
[[nodiscard]] ImageList read_image_list(const std::string& sequence_dir, const std::string& name);

/// What is wrong with the list itself: lines, order, files that are not there.
[[nodiscard]] Findings check_image_list(const ImageList& list);

}  // namespace cpslam::diagnosis
