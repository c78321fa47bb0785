#include "dense/cloud_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <sstream>

#include "cpslam/error.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

/// Reads what a PLY's header says, and nothing else.
std::vector<CloudPoint> parse_ply(const std::string& bytes) {
  const std::string end = "end_header\n";
  const std::size_t header_end = bytes.find(end) + end.size();
  std::istringstream header(bytes.substr(0, header_end));
  std::string line;
  std::getline(header, line);
  EXPECT_EQ(line, "ply");
  std::getline(header, line);
  EXPECT_EQ(line, "format binary_little_endian 1.0");
  std::size_t n = 0;
  std::vector<std::string> properties;
  while (std::getline(header, line)) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element") {
      EXPECT_EQ(second, "vertex");
      n = std::stoul(third);
    } else if (first == "property") {
      properties.push_back(second + " " + third);
    }
  }
  EXPECT_EQ(properties, (std::vector<std::string>{"float x", "float y", "float z", "float nx", "float ny",
                                                  "float nz", "uchar red", "uchar green", "uchar blue"}));
  EXPECT_EQ(bytes.size(), header_end + n * 27);
  std::vector<CloudPoint> points(n);
  std::size_t at = header_end;
  const auto byte = [&] { return static_cast<std::uint8_t>(bytes.at(at++)); };
  const auto number = [&] {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>(byte()) << (8 * i);
    return std::bit_cast<float>(bits);
  };
  for (CloudPoint& point : points) {
    for (float& value : point.position_m) value = number();
    for (float& value : point.normal) value = number();
    for (std::uint8_t& value : point.rgb) value = byte();
  }
  return points;
}

TEST(CloudFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  std::vector<CloudPoint> points(3);
  points[0] = {{1.5F, -2.25F, 1e-20F}, {0.0F, 0.6F, -0.8F}, {0, 127, 255}};
  points[2] = {{-1e6F, 3.0F, 0.1F}, {1.0F, 0.0F, 0.0F}, {10, 13, 26}};
  write_ply(folder.file("a.ply"), points);
  const std::vector<CloudPoint> read = parse_ply(TemporaryFolder::content(folder.file("a.ply")));
  ASSERT_EQ(read.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(read[i].position_m, points[i].position_m);
    EXPECT_EQ(read[i].normal, points[i].normal);
    EXPECT_EQ(read[i].rgb, points[i].rgb);
  }
}

TEST(CloudFile, AnEmptyCloudIsAFileToo) {
  const TemporaryFolder folder;
  write_ply(folder.file("a.ply"), {});
  EXPECT_TRUE(parse_ply(TemporaryFolder::content(folder.file("a.ply"))).empty());
}

TEST(CloudFile, WhatCannotBeWrittenIsNamed) {
  const std::vector<CloudPoint> points(1000);
  for (const char* const path : {"/dev/full", "/no_such_folder/a.ply"}) {
    try {
      write_ply(path, points);
      ADD_FAILURE() << path << " was written";
    } catch (const RunError& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cpslam
