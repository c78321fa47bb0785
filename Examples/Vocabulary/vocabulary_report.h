#pragma once

#include <string>

#include "place/vocabulary.h"

namespace cpslam::program {

/// What there is to know about a vocabulary, in a few lines.
[[nodiscard]] std::string to_text(const Vocabulary& vocabulary);

}  // namespace cpslam::program
