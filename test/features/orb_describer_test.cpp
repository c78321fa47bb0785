#include "features/orb_describer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/features2d.hpp>

#include "features/gaussian_blur.h"
#include "features/image_pyramid.h"
#include "features/orb_extractor.h"
#include "test_images.h"

namespace cpslam {
namespace {

int bits_apart(const Descriptor& ours, const cv::Mat& theirs) {
  Descriptor other;
  std::memcpy(other.words.data(), theirs.data, sizeof(other.words));
  return descriptor_distance(ours, other);
}

std::vector<cv::Mat> pictures() {
  std::vector<cv::Mat> images = test::desk_frames(60);
  images.push_back(test::textured_image(640, 480, 3));
  return images;
}

TEST(OrbDescriber, PatternStaysInsideTheBorder) {
  double reach = 0.0;
  for (const PatternPair& p : kOrbPattern)
    reach = std::max({reach, std::hypot(p.x0, p.y0), std::hypot(p.x1, p.y1)});
  EXPECT_LE(std::lround(reach), kOrbBorderPx - 1);
}

/// The descriptor straight from the definition, on a picture blurred by OpenCV.
Descriptor describe_by_definition(const cv::Mat& blurred, cv::Point at, float angle_deg) {
  const double angle = static_cast<double>(angle_deg * static_cast<float>(CV_PI / 180.0));
  const auto cosine = static_cast<float>(std::cos(angle));
  const auto sine = static_cast<float>(std::sin(angle));
  const auto grey = [&](int x, int y) {
    const auto px = static_cast<float>(x);
    const auto py = static_cast<float>(y);
    return blurred.at<std::uint8_t>(at.y + cvRound(px * sine + py * cosine),
                                    at.x + cvRound(px * cosine - py * sine));
  };
  Descriptor descriptor;
  for (std::size_t i = 0; i < kOrbPattern.size(); ++i) {
    const PatternPair& p = kOrbPattern[i];
    if (grey(p.x0, p.y0) < grey(p.x1, p.y1)) descriptor.words[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  return descriptor;
}

TEST(OrbDescriber, EqualsTheDefinition) {
  for (const cv::Mat& image : pictures()) {
    OrbFeatures features;
    OrbExtractor(OrbSettings{}).extract(image, features);
    cv::Mat blurred;
    cv::GaussianBlur(image, blurred, cv::Size(7, 7), 2.0, 2.0, cv::BORDER_REFLECT_101);
    int n = 0;
    for (std::size_t i = 0; i < features.keypoints.size() && features.keypoints[i].octave == 0; ++i, ++n) {
      const OrbKeypoint& k = features.keypoints[i];
      const Descriptor expected =
          describe_by_definition(blurred, {static_cast<int>(k.x), static_cast<int>(k.y)}, k.angle_deg);
      // A pattern point within float rounding of half a pixel may go either way.
      EXPECT_LE(descriptor_distance(features.descriptors[i], expected), 1);
    }
    EXPECT_GT(n, 200);
  }
}

TEST(OrbDescriber, AgreesWithOpenCvOnEveryLevel) {
  // Each level is given to OpenCV as a picture of its own, since its pyramid interpolates with other
  // roundings. cv::ORB blurs inside a larger picture, where OpenCV takes a filter that rounds otherwise than
  // cv::GaussianBlur on a whole picture, which is what ORB-SLAM2 uses: that flips about one bit in a
  // thousand.
  const auto orb = cv::ORB::create(1000, 1.2F, 8, kOrbBorderPx, 0, 2, cv::ORB::FAST_SCORE, 31);
  long n_bits = 0;
  long n_apart = 0;
  for (const cv::Mat& image : pictures()) {
    OrbFeatures features;
    OrbExtractor(OrbSettings{}).extract(image, features);
    ImagePyramid pyramid(1.2, 8);
    pyramid.build(image);
    for (int level = 0; level < 8; ++level) {
      std::vector<cv::KeyPoint> keypoints;
      for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
        const OrbKeypoint& k = features.keypoints[i];
        if (k.octave != level) continue;
        const float scale = pyramid.scale(level);
        keypoints.emplace_back(std::round(k.x / scale), std::round(k.y / scale), 31.0F, k.angle_deg,
                               k.response, 0, static_cast<int>(i));
      }
      const std::size_t n = keypoints.size();
      cv::Mat descriptors;
      orb->compute(pyramid.level(level), keypoints, descriptors);
      ASSERT_EQ(keypoints.size(), n) << "OpenCV dropped keypoints at the border";
      for (std::size_t i = 0; i < n; ++i) {
        const auto ours = static_cast<std::size_t>(keypoints[i].class_id);
        n_apart += bits_apart(features.descriptors[ours], descriptors.row(static_cast<int>(i)));
        n_bits += 256;
      }
    }
  }
  EXPECT_GT(n_bits, 256 * 900);
  EXPECT_LE(static_cast<double>(n_apart), 2e-3 * static_cast<double>(n_bits)) << n_apart << " of " << n_bits;
}

TEST(OrbDescriber, StaysWithinAFewBitsOfOpenCvsOwnPyramid) {
  const auto orb = cv::ORB::create(1000, 1.2F, 8, kOrbBorderPx, 0, 2, cv::ORB::FAST_SCORE, 31);
  for (const cv::Mat& image : pictures()) {
    OrbFeatures features;
    OrbExtractor(OrbSettings{}).extract(image, features);
    std::vector<cv::KeyPoint> keypoints;
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      const OrbKeypoint& k = features.keypoints[i];
      keypoints.emplace_back(k.x, k.y, 31.0F, k.angle_deg, k.response, k.octave, static_cast<int>(i));
    }
    cv::Mat descriptors;
    orb->compute(image, keypoints, descriptors);
    ASSERT_GT(keypoints.size(), 900U);
    double sum = 0.0;
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      const auto ours = static_cast<std::size_t>(keypoints[i].class_id);
      sum += bits_apart(features.descriptors[ours], descriptors.row(static_cast<int>(i)));
    }
    EXPECT_LT(sum / static_cast<double>(keypoints.size()), 8.0) << "bits of 256 per descriptor";
  }
}

TEST(OrbDescriber, IsTheSameWithEveryInstructionSet) {
  ImagePyramid pyramid(1.2, 1);
  pyramid.build(test::textured_image(200, 150, 4));
  GaussianBlur blur;
  const cv::Mat& blurred = blur.blur(pyramid.level(0));
  const OrbDescriber baseline(Simd::kBaseline);
  for (const Simd simd : test::simds()) {
    const OrbDescriber describer(simd);
    for (int i = 0; i < 360; ++i) {
      const auto angle = static_cast<float>(i) + 0.37F;
      EXPECT_EQ(describer.describe(blurred, 19 + i % 162, 19 + i % 112, angle),
                baseline.describe(blurred, 19 + i % 162, 19 + i % 112, angle));
    }
  }
}

}  // namespace
}  // namespace cpslam
