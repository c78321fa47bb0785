#pragma once

#include <string>
#include <vector>

namespace cpslam::program {

/// Turns what --classes says into a network's class indices: whole numbers as they are, names by their line
/// in the .names file beside the network's .cfg: the one of the same name, else the only one in that folder.
/// Throws InputError naming the class and the file.
[[nodiscard]] std::vector<int> class_indices(const std::vector<std::string>& classes, const std::string& cfg);

}  // namespace cpslam::program
