#pragma once

#include <string>
#include <vector>

namespace cpslam {

/// Paths of a folder's .png, .jpg and .jpeg files in the order of their names. Throws InputError naming the
/// folder when it cannot be read or has none.
[[nodiscard]] std::vector<std::string> pictures_in(const std::string& folder);

}  // namespace cpslam
