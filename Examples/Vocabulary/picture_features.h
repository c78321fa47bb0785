#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cpslam/settings.h"
#include "place/vocabulary_training.h"

namespace cpslam::program {

/// Where the pictures to train on come from.
struct PictureSelection {
  std::vector<std::string> sources;  ///< as find_pictures() takes them
  std::size_t every = 1;             ///< of a sequence, only every so many-th picture
};

/// The ORB features of all pictures; those that cannot be read, or show none, are named and left out.
/// Throws InputError for a source without pictures, or when no picture is left; RunError on Ctrl-C.
[[nodiscard]] std::vector<ImageDescriptors> extract_features(const PictureSelection& selection,
                                                             const OrbSettings& settings, bool quiet);

}  // namespace cpslam::program
