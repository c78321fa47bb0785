#pragma once

#include <string>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

struct StampedBoxes {
  double time_s = 0.0;  ///< the colour image's
  std::vector<PersonBox> boxes;
};

/// "x y width height confidence" of a box, as person_boxes.txt has it.
[[nodiscard]] std::string to_text(const PersonBox& box);

/// Writes person_boxes.txt: "timestamp x y width height confidence", one box a line; frames without a person
/// have no line. Through a temporary file that is renamed. Throws RunError naming the file.
void write_person_boxes(const std::string& path, const std::vector<StampedBoxes>& frames);

/// Reads such a file, frames in the order of their stamps. Throws InputError naming file and line.
[[nodiscard]] std::vector<StampedBoxes> read_person_boxes(const std::string& path);

}  // namespace cpslam
