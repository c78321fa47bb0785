#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "map/map.h"
#include "place/vocabulary.h"

namespace cpslam {

/// A keyframe that may show the place of a query.
struct PlaceCandidate {
  KeyFrameId keyframe;
  double score = 0.0;        ///< of this keyframe alone, 0 to 1
  double group_score = 0.0;  ///< its own and that of the alike keyframes around it
  int common_words = 0;
};

/// What a query leaves out.
struct PlaceQuery {
  std::vector<KeyFrameId> excluded;  ///< in any order
  double min_score = 0.0;            ///< of a single keyframe
  std::size_t max_candidates = 10;
};

/// The keyframes of a map by their words: an inverted index from every word to the keyframes that have it
/// (Sivic and Zisserman 2003). Holds the words of its keyframes.
///
/// Thread-safe, with a mutex of its own that is never held together with the map's. A keyframe culled from
/// the map and not erased here yet is not handed out.
class KeyFrameDatabase {
 public:
  explicit KeyFrameDatabase(std::size_t n_words) : postings_(n_words) {}

  /// words must come from the vocabulary of this database's other keyframes. A keyframe that is there already
  /// gets the new words.
  void add(KeyFrameId keyframe, std::shared_ptr<const ImageWords> words);
  /// Does nothing for a keyframe that is not there.
  void erase(KeyFrameId keyframe);
  /// Forgets all keyframes.
  void clear();
  /// Null for a keyframe that is not there.
  [[nodiscard]] std::shared_ptr<const ImageWords> words(KeyFrameId keyframe) const;
  [[nodiscard]] std::size_t size() const;

  /// Keyframes that look like the query, best first (equal ones: the older first), at most one of a
  /// neighbourhood. As in Mur-Artal et al. 2015, III-E: those with at least 0.8 of the most common words take
  /// part; each collects the scores of those among its ten best covisible keyframes that take part too; of
  /// each neighbourhood the best keyframe stands for it; groups below 0.75 of the best group go. Takes a
  /// shared lock of the map, which the caller must not hold.
  [[nodiscard]] std::vector<PlaceCandidate> candidates(const Map& map, const BowVector& bow,
                                                       const PlaceQuery& query) const;

 private:
  struct Posting {
    KeyFrameId keyframe;
    float weight = 0.0F;
  };
  [[nodiscard]] std::map<KeyFrameId, PlaceCandidate> compare(const BowVector& bow,
                                                             std::span<const KeyFrameId> excluded) const;
  void erase_postings(KeyFrameId keyframe, const BowVector& bow);

  mutable std::mutex mutex_;                    // guards all below
  std::vector<std::vector<Posting>> postings_;  // by word, in the order of add()
  std::map<KeyFrameId, std::shared_ptr<const ImageWords>> keyframes_;
};

}  // namespace cpslam
