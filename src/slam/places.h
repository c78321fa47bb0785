#pragma once

#include <utility>

#include "place/vocabulary.h"
#include "slam/keyframe_database.h"

namespace cpslam {

/// What recognises places: the words, and the keyframes that have them. Thread-safe.
struct Places {
  explicit Places(Vocabulary words) : vocabulary(std::move(words)), database(vocabulary.n_words()) {}

  const Vocabulary vocabulary;
  KeyFrameDatabase database;
};

}  // namespace cpslam
