#pragma once

#include <string_view>

#include "place/vocabulary.h"

namespace cpslam {

/// Reads the text of public ORB vocabularies (ORBvoc.txt). First line: branching, depth, scoring, weighting.
/// Then a line for each node but the root, which is node 0; the others count from 1:
///   number of its parent, 1 for a leaf or else 0, the 32 bytes of its descriptor, its weight.
/// Parents come before their children. Scoring must be 0 (L1) and weighting 0 (TF-IDF), which is what
/// Vocabulary does. Throws InputError naming the line.
[[nodiscard]] Vocabulary vocabulary_from_text(std::string_view text);

}  // namespace cpslam
