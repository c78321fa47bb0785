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

/// ORB features (Rublee et al. 2011) spread evenly by cells and a quadtree (Mur-Artal et al. 2015),
/// compatible with public ORB vocabularies. Holds its working memory between calls: one extractor per thread.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbSettings& settings);
  ~OrbExtractor();
  OrbExtractor(OrbExtractor&&) noexcept;
  OrbExtractor& operator=(OrbExtractor&&) noexcept;

  /// Extracts from an 8-bit grey image; throws InputError on another type. Deterministic.
  void extract(const cv::Mat& grey, OrbFeatures& features);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam
