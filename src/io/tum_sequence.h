#pragma once

#include <string>
#include <vector>

namespace cpslam {

/// One colour-depth pair of a TUM-format sequence.
struct RgbdEntry {
  double time_s = 0.0;  ///< stamp of the colour image; every output carries this one
  double depth_time_s = 0.0;
  std::string colour_path;  ///< absolute or relative to the working directory, ready to open
  std::string depth_path;
};

/// A colour image of a TUM-format sequence.
struct StampedImage {
  double time_s = 0.0;
  std::string path;  ///< ready to open
};

/// The sequence's rgb.txt. Throws InputError as associate_sequence() does.
[[nodiscard]] std::vector<StampedImage> read_colour_list(const std::string& sequence_dir);

/// Pairs the sequence's rgb.txt and depth.txt: one-to-one, closest pairs first, less than max_difference_s
/// apart. Throws InputError naming file and line for a missing, empty, malformed or unsorted list (NaN and
/// repeated stamps included), and when no pair is found.
[[nodiscard]] std::vector<RgbdEntry> associate_sequence(const std::string& sequence_dir,
                                                        double max_difference_s = 0.02);

/// Reads an associations file of associate.py ("time rgb_path time depth_path" a line). Errors as above.
[[nodiscard]] std::vector<RgbdEntry> read_associations(const std::string& sequence_dir,
                                                       const std::string& associations_path);

}  // namespace cpslam
