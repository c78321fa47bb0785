#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "features/corner_detector.h"
#include "features/image_mask.h"
#include "features/image_pyramid.h"
#include "features/orb_extractor.h"
#include "test_images.h"

namespace cpslam::test {

inline const cv::Size kSize(640, 480);

inline OrbFeatures extract(const cv::Mat& image, const ExtractionPrior& prior = {}) {
  OrbFeatures features;
  OrbExtractor(OrbSettings{}).extract(image, features, prior);
  return features;
}

inline bool same(const OrbKeypoint& a, const OrbKeypoint& b) {
  return a.x == b.x && a.y == b.y && a.angle_deg == b.angle_deg && a.response == b.response &&
         a.octave == b.octave;
}

inline void expect_equal(const OrbFeatures& a, const OrbFeatures& b) {
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  EXPECT_TRUE(std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), same));
  EXPECT_EQ(a.descriptors, b.descriptors);
}

/// Coarse mask of a rectangle, px.
inline cv::Mat coarse_mask(const cv::Rect& rectangle_px) {
  cv::Mat mask = cv::Mat::zeros(kSize.height / 4, kSize.width / 4, CV_8UC1);
  mask(cv::Rect(rectangle_px.x / 4, rectangle_px.y / 4, rectangle_px.width / 4, rectangle_px.height / 4))
      .setTo(255);
  return mask;
}

inline int n_inside(const OrbFeatures& features, const cv::Mat& mask) {
  const ImageMask m(mask, kSize);
  return static_cast<int>(std::count_if(features.keypoints.begin(), features.keypoints.end(),
                                        [&m](const OrbKeypoint& k) { return m.covers(k.x, k.y); }));
}

inline int n_outside(const OrbFeatures& features, const cv::Mat& mask) {
  return static_cast<int>(features.keypoints.size()) - n_inside(features, mask);
}

/// Corners outside the mask from min_th_fast on, over all levels.
inline int n_corners_outside(const cv::Mat& image, const cv::Mat& mask) {
  const OrbSettings settings;
  ImagePyramid pyramid(settings.scale_factor, settings.n_levels);
  pyramid.build(image);
  CornerDetector detector(settings.min_th_fast);
  std::vector<Corner> corners;
  const ImageMask m(mask, kSize);
  int n = 0;
  for (int i = 0; i < pyramid.n_levels(); ++i) {
    detector.detect(pyramid.level(i), corners);
    n += static_cast<int>(std::count_if(corners.begin(), corners.end(), [&](const Corner& c) {
      return m.empty() || !m.covers(static_cast<float>(c.x) * pyramid.scale(i),
                                    static_cast<float>(c.y) * pyramid.scale(i));
    }));
  }
  return n;
}

/// The contrast of a textured image scaled down: few corners reach the first threshold.
inline cv::Mat faint_image(std::uint64_t seed, double contrast) {
  cv::Mat faint;
  textured_image(kSize.width, kSize.height, seed).convertTo(faint, CV_8UC1, contrast, 100.0);
  return faint;
}

}  // namespace cpslam::test
