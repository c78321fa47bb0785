#include "dense/cloud_file.h"

#include <bit>
#include <cstdint>

#include "io/atomic_file.h"

namespace cpslam {
namespace {

constexpr std::size_t kBytesPerPoint = 6 * sizeof(float) + 3;

void append(std::string& bytes, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xFFU));
}

}  // namespace

void write_ply(const std::string& path, std::span<const CloudPoint> points) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment CP-SLAM; metres, world frame of the trajectories\n";
  bytes += "element vertex " + std::to_string(points.size()) + "\n";
  for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"})
    bytes += std::string("property float ") + name + "\n";
  for (const char* const name : {"red", "green", "blue"})
    bytes += std::string("property uchar ") + name + "\n";
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + points.size() * kBytesPerPoint);
  for (const CloudPoint& point : points) {
    for (const float value : point.position_m) append(bytes, value);
    for (const float value : point.normal) append(bytes, value);
    for (const std::uint8_t value : point.rgb) bytes.push_back(static_cast<char>(value));
  }
  write_file_atomically(path, bytes);
}

}  // namespace cpslam
