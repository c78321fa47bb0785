#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "cpslam/settings.h"
#include "features/descriptor.h"

namespace cpslam {

/// One ORB keypoint in the image (distorted px of level 0).
struct OrbKeypoint {
  float x = 0.0F;
  float y = 0.0F;
  float angle_deg = 0.0F;  ///< [0, 360), clockwise in the image (y down)
  float response = 0.0F;   ///< FAST score
  int octave = 0;          ///< pyramid level, 0 = full resolution
};

struct OrbFeatures {
  std::vector<OrbKeypoint> keypoints;
  std::vector<Descriptor> descriptors;  ///< parallel to keypoints
};

/// What is expected to be in an image before it was looked at.
struct ExtractionPrior {
  cv::Mat people;  ///< a mask as ImageMask takes it; empty or all zero: nobody, n_on_people plays no part
  int n_on_people = 150;  ///< at most this many features are taken inside the mask, on top of n_features
};

/// ORB features (Rublee et al. 2011) spread evenly by cells and a quadtree (Mur-Artal et al. 2015),
/// compatible with public ORB vocabularies. Holds its working memory between calls: one extractor per thread.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbSettings& settings);
  ~OrbExtractor();
  OrbExtractor(OrbExtractor&&) noexcept;
  OrbExtractor& operator=(OrbExtractor&&) noexcept;

  /// Extracts from an 8-bit grey image. Where people are expected, the rest of the image gets n_features as
  /// if it were all there is: what the ordinary rules leave short, weak corners of well textured cells and
  /// other levels make up for, down to min_th_fast. Throws InputError on another type of image, or a mask
  /// that does not fit it. Deterministic.
  void extract(const cv::Mat& grey, OrbFeatures& features, const ExtractionPrior& prior = {});

  /// Appends up to `wanted` features of the image extract() last saw, outside `excluded` (as ImageMask takes
  /// it; empty excludes nothing) and more than 2 px (of their level) from all of their octave in `features`.
  /// Goes down to min_th_fast at once; the pyramid and its corners are those already made. Returns how many
  /// were added. Deterministic.
  int extract_more(const cv::Mat& excluded, int wanted, OrbFeatures& features);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
