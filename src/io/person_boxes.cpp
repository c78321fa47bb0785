#include "io/person_boxes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "io/atomic_file.h"
#include "io/text_table.h"

namespace cpslam {

std::string to_text(const PersonBox& box) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.2f %.2f %.2f %.2f %.6f", box.x, box.y, box.width, box.height,
                box.confidence);
  return text.data();
}

void write_person_boxes(const std::string& path, const std::vector<StampedBoxes>& frames) {
  std::string text = "# person boxes: timestamp x y width height confidence (px, top-left corner)\n";
  for (const StampedBoxes& frame : frames) {
    for (const PersonBox& box : frame.boxes) {
      text += stamp_text(frame.time_s) + " " + to_text(box) + "\n";
    }
  }
  write_file_atomically(path, text);
}

std::vector<StampedBoxes> read_person_boxes(const std::string& path) {
  TextTable table(path);
  std::vector<std::pair<double, PersonBox>> rows;
  while (table.next_row()) {
    table.expect_fields(6, "timestamp x y width height confidence");
    const PersonBox box{table.number(1), table.number(2), table.number(3), table.number(4), table.number(5)};
    if (box.width <= 0.0 || box.height <= 0.0) table.fail("width and height of a box must be positive");
    if (box.confidence < 0.0 || box.confidence > 1.0) table.fail("the confidence must lie in [0, 1]");
    rows.emplace_back(table.number(0), box);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<StampedBoxes> frames;
  for (const auto& [time_s, box] : rows) {
    if (frames.empty() || frames.back().time_s != time_s) frames.push_back({time_s, {}});
    frames.back().boxes.push_back(box);
  }
  return frames;
}

}  // namespace cpslam
