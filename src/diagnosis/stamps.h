#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "diagnosis/finding.h"

namespace cpslam::diagnosis {

/// The rhythm of a list of stamps, in the order in which they come.
struct Rhythm {
  double interval_s = 0.0;  ///< median of those that grow
  double longest_s = 0.0;
  double longest_at_s = 0.0;   ///< stamp at which the longest interval begins
  std::size_t n_repeated = 0;  ///< stamps equal to the one before
  std::size_t n_backward = 0;  ///< stamps before the one before
  std::size_t n_gaps = 0;      ///< intervals of more than 1.6 medians
  double missing_share = 0.0;  ///< pictures that the gaps swallowed, of all there should be
};

[[nodiscard]] Rhythm find_rhythm(std::span<const double> stamps_s);

/// Rate, gaps, repeats and steps backward of the pictures called `name` ("colour"). nominal_fps: of the
/// settings.
[[nodiscard]] Findings check_rhythm(const std::string& name, std::span<const double> stamps_s,
                                    std::optional<double> nominal_fps);

/// How colour and depth pair up: pictures without partner, and how far apart the partners' stamps are.
[[nodiscard]] Findings check_pairs(std::span<const double> colour_s, std::span<const double> depth_s);

}  // namespace cpslam::diagnosis
