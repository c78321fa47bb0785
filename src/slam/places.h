#pragma once

#include <utility>

#include "map/map.h"
#include "place/vocabulary.h"
#include "slam/keyframe_database.h"

namespace cpslam {

/// What recognises places: the words, and the keyframes that have them. Thread-safe.
struct Places {
  explicit Places(Vocabulary words) : vocabulary(std::move(words)), database(vocabulary.n_words()) {}

  /// Finds the words of a keyframe of the map and adds it to the database; does nothing for one that is
  /// gone. Takes a shared lock of the map.
  void remember(const Map& map, KeyFrameId keyframe);

  const Vocabulary vocabulary;
  KeyFrameDatabase database;
};

}  // namespace cpslam
