#include "io/image_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/image_integrity.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const cv::Size kSize(32, 24);

class ImageReader : public testing::Test {
 protected:
  RgbdEntry entry(const std::string& colour_bytes, const std::string& depth_bytes) {
    return {1.5, 1.51, folder_.write("colour.img", colour_bytes), folder_.write("depth.img", depth_bytes)};
  }
  /// The error of a pair; checks that it is one line and that no image comes with it.
  std::string error(const RgbdEntry& pair) {
    const RgbdImages images = read_rgbd(pair);
    EXPECT_TRUE(images.colour.empty());
    EXPECT_TRUE(images.depth.empty());
    EXPECT_EQ(images.time_s, pair.time_s);
    EXPECT_THAT(images.error, Not(HasSubstr("\n")));
    return images.error;
  }
  TemporaryFolder folder_;
  std::string png_ = encode(".png", noise_image(kSize, CV_8UC3));
  std::string jpeg_ = encode(".jpg", noise_image(kSize, CV_8UC3));
  std::string depth_png_ = encode(".png", noise_image(kSize, CV_16UC1));
  std::string depth_tiff_ = encode(".tiff", noise_image(kSize, CV_32FC1));
};

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST_F(ImageReader, ReadsPngAndDepthBitForBit) {
  const RgbdImages images = read_rgbd(entry(png_, depth_png_));
  EXPECT_EQ(images.error, "");
  EXPECT_EQ(images.time_s, 1.5);
  EXPECT_TRUE(same(images.colour, noise_image(kSize, CV_8UC3)));
  EXPECT_TRUE(same(images.depth, noise_image(kSize, CV_16UC1)));
}

TEST_F(ImageReader, ReadsJpegGreyAndFloatDepth) {
  const RgbdImages jpeg = read_rgbd(entry(jpeg_, depth_tiff_));
  EXPECT_EQ(jpeg.error, "");
  EXPECT_EQ(jpeg.colour.type(), CV_8UC3);
  EXPECT_TRUE(same(jpeg.depth, noise_image(kSize, CV_32FC1)));
  const RgbdImages grey = read_rgbd(entry(encode(".png", noise_image(kSize, CV_8UC1)), depth_png_));
  EXPECT_EQ(grey.error, "");
  EXPECT_EQ(grey.colour.type(), CV_8UC1);
}

TEST_F(ImageReader, DropsTransparency) {
  const RgbdImages images = read_rgbd(entry(encode(".png", noise_image(kSize, CV_8UC4)), depth_png_));
  EXPECT_EQ(images.error, "");
  EXPECT_EQ(images.colour.type(), CV_8UC3);
}

TEST_F(ImageReader, NamesTheFileThatCannotBeOpened) {
  RgbdEntry pair = entry(png_, depth_png_);
  pair.depth_path = folder_.file("none.png");
  EXPECT_THAT(error(pair), AllOf(HasSubstr("none.png"), HasSubstr("No such file")));
  pair.depth_path = folder_.path();
  EXPECT_THAT(error(pair), HasSubstr("is a folder"));
  EXPECT_THAT(error(entry("", depth_png_)), AllOf(HasSubstr("colour.img"), HasSubstr("is empty")));
  EXPECT_THAT(error(entry("hello", depth_png_)), AllOf(HasSubstr("colour.img"), HasSubstr("is not a PNG")));
  EXPECT_THAT(error(entry(encode(".bmp", noise_image(kSize, CV_8UC3)), depth_png_)),
              HasSubstr("is not a PNG"));
}

TEST_F(ImageReader, EveryTruncationIsAnError) {
  for (const std::string& whole : {png_, jpeg_}) {
    for (std::size_t length = 1; length < whole.size(); length += 1 + whole.size() / 29) {
      EXPECT_THAT(error(entry(whole.substr(0, length), depth_png_)), HasSubstr("colour.img")) << length;
    }
    EXPECT_THAT(error(entry(whole.substr(0, whole.size() - 1), depth_png_)), HasSubstr("is truncated"));
    EXPECT_EQ(read_rgbd(entry(whole + "trailing", depth_png_)).error, "");
  }
  for (const std::string& whole : {depth_png_, depth_tiff_}) {
    for (std::size_t length = 1; length < whole.size(); length += 1 + whole.size() / 29) {
      EXPECT_THAT(error(entry(png_, whole.substr(0, length))), HasSubstr("depth.img")) << length;
    }
  }
}

TEST_F(ImageReader, ADamagedPngIsAnError) {
  std::string damaged = png_;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  EXPECT_THAT(error(entry(damaged, depth_png_)), AllOf(HasSubstr("colour.img"), HasSubstr("damaged")));
}

TEST_F(ImageReader, TheEndOfAThumbnailIsNotTheEndOfAJpeg) {
  // An application segment that holds a whole small JPEG, as cameras write it, in front of the image's own.
  const std::string thumbnail = encode(".jpg", noise_image({8, 8}, CV_8UC1));
  const std::size_t length = thumbnail.size() + 2;
  std::string with_thumbnail = "\xFF\xD8\xFF\xE5";
  with_thumbnail += {static_cast<char>(length / 256), static_cast<char>(length % 256)};
  with_thumbnail += thumbnail + jpeg_.substr(2);
  EXPECT_EQ(image_integrity_error(with_thumbnail), "");
  EXPECT_EQ(read_rgbd(entry(with_thumbnail, depth_png_)).error, "");
  EXPECT_THAT(image_integrity_error(with_thumbnail.substr(0, thumbnail.size() + 100)),
              HasSubstr("is truncated"));
}

TEST_F(ImageReader, ProgressiveJpegsAndRestartMarkersAreComplete) {
  std::vector<unsigned char> bytes;
  ASSERT_TRUE(cv::imencode(".jpg", noise_image({200, 100}, CV_8UC3), bytes,
                           {cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 1}));
  const std::string jpeg(bytes.begin(), bytes.end());
  EXPECT_EQ(image_integrity_error(jpeg), "");
  for (std::size_t length = 0; length < jpeg.size(); length += 7) {
    ASSERT_NE(image_integrity_error(std::string_view(jpeg).substr(0, length)), "") << length;
  }
}

TEST_F(ImageReader, WrongTypes) {
  const std::string colour16 = encode(".png", noise_image(kSize, CV_16UC3));
  EXPECT_THAT(error(entry(colour16, depth_png_)),
              AllOf(HasSubstr("colour.img"), HasSubstr("16-bit with 3 channels"), HasSubstr("8-bit")));
  EXPECT_THAT(error(entry(depth_png_, depth_png_)), HasSubstr("16-bit with 1 channel:"));
  EXPECT_THAT(error(entry(png_, encode(".png", noise_image(kSize, CV_8UC1)))),
              AllOf(HasSubstr("depth.img"), HasSubstr("8-bit with 1 channel:")));
  EXPECT_THAT(error(entry(png_, png_)), AllOf(HasSubstr("depth.img"), HasSubstr("8-bit with 3 channels")));
  EXPECT_THAT(error(entry(png_, colour16)), HasSubstr("16-bit with 3 channels"));
}

TEST_F(ImageReader, DifferentSizes) {
  EXPECT_THAT(error(entry(png_, encode(".png", noise_image({24, 32}, CV_16UC1)))),
              AllOf(HasSubstr("depth.img' is 24x32 px"), HasSubstr("colour.img' 32x24 px")));
}

class ReadAheadTest : public ImageReader {
 protected:
  /// n good pairs whose colour images differ.
  std::vector<RgbdEntry> pairs(int n) {
    std::vector<RgbdEntry> entries;
    const std::string depth = folder_.write("depth.png", depth_png_);
    for (int i = 0; i < n; ++i) {
      const std::string bytes = encode(".png", noise_image(kSize, CV_8UC3, static_cast<std::uint64_t>(i)));
      entries.push_back(
          {static_cast<double>(i), 0.0, folder_.write(std::to_string(i) + ".png", bytes), depth});
    }
    return entries;
  }
};

TEST_F(ReadAheadTest, DeliversEveryPairInOrder) {
  for (const std::size_t capacity : {1U, 4U, 100U}) {
    ReadAhead reader(pairs(20), capacity);
    RgbdImages images;
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(reader.next(images));
      EXPECT_EQ(images.time_s, i);
      EXPECT_TRUE(same(images.colour, noise_image(kSize, CV_8UC3, static_cast<std::uint64_t>(i))));
    }
    EXPECT_FALSE(reader.next(images));
    EXPECT_FALSE(reader.next(images));
  }
}

TEST_F(ReadAheadTest, ABadFileCostsOneFrame) {
  std::vector<RgbdEntry> entries = pairs(5);
  entries[2].colour_path = folder_.file("gone.png");
  ReadAhead reader(entries, 2);
  RgbdImages images;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(reader.next(images));
    EXPECT_EQ(images.error.empty(), i != 2) << images.error;
  }
  EXPECT_FALSE(reader.next(images));
}

TEST_F(ReadAheadTest, MayBeDestroyedAtAnyTime) {
  const std::vector<RgbdEntry> entries = pairs(10);
  for (int taken = 0; taken <= 10; ++taken) {
    ReadAhead reader(entries, 3);
    RgbdImages images;
    for (int i = 0; i < taken; ++i) ASSERT_TRUE(reader.next(images));
  }
}

TEST_F(ReadAheadTest, AnEmptyListEndsAtOnce) {
  ReadAhead reader({}, 3);
  RgbdImages images;
  EXPECT_FALSE(reader.next(images));
}

}  // namespace
}  // namespace cpslam
