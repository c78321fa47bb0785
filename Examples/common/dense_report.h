#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace cpslam::program {

/// The dense map that a run made.
struct DenseReport {
  std::size_t points = 0;
  std::size_t keyframes = 0;  ///< it is made of
  std::size_t dropped = 0;    ///< others, for want of memory
  std::size_t carved_voxels = 0;
  double seconds = 0.0;  ///< to make and to write it
};

[[nodiscard]] nlohmann::ordered_json dense_json(const DenseReport& report);
[[nodiscard]] std::string dense_text(const DenseReport& report);

}  // namespace cpslam::program
