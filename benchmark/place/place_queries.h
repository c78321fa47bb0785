#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/se3.h"
#include "place/vocabulary.h"

namespace cpslam::bench {

/// A picture whose place is known.
struct PlacedImage {
  std::string path;
  std::size_t source = 0;    ///< where it was loaded from
  std::size_t sequence = 0;  ///< pictures of other sequences show other places
  double time_s = 0.0;
  SE3 world_from_camera;
  std::vector<Descriptor> descriptors;
};

/// Every `step`-th picture of a TUM-format sequence with ground truth; or of a list or folder (a sequence
/// without groundtruth.txt among them), where each picture shows a place of its own. Sequences are numbered
/// from next_sequence on, which moves on.
[[nodiscard]] std::vector<PlacedImage> load_places(const std::string& source, std::size_t step,
                                                   std::size_t& next_sequence);

struct QueryOptions {
  double exclude_s = 3.0;  ///< pictures of the same sequence this near in time are not asked about
  double near_m = 0.4;     ///< two views show the same place when neither position
  double near_deg = 25.0;  ///< nor direction differ by more;
  double far_m = 2.0;      ///< they show different ones when either differs
  double far_deg = 70.0;   ///< by more than this: with less they overlap
};

enum class Relation { kSame, kUnclear, kOther };

/// The most alike among all other pictures.
struct Answer {
  std::size_t query = 0;
  std::size_t first = 0;
  double score = 0.0;  ///< 0: none has a common word, and first means nothing
  Relation relation = Relation::kUnclear;
  bool answerable = false;  ///< the same place is among the others
};

/// Asks every picture.
[[nodiscard]] std::vector<Answer> ask(const Vocabulary& vocabulary, std::span<const PlacedImage> images,
                                      const QueryOptions& options);

struct PlaceQuality {
  std::size_t answerable = 0;
  std::size_t right = 0;  ///< the same place came first
  std::size_t wrong = 0;  ///< another place came first, answerable or not
  /// The largest share of answerable queries that a threshold on the score lets through rightly while no
  /// other place, or at most one in a hundred answers, passes it.
  double recall_without_false = 0.0;
  double recall_with_1_percent_false = 0.0;

  [[nodiscard]] double recall_at_1() const {
    return answerable == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(answerable);
  }
};

[[nodiscard]] PlaceQuality judge(std::vector<Answer> answers);

}  // namespace cpslam::bench
