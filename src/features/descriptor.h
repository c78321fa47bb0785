#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace cpslam {

/// 256-bit binary descriptor; bit i of the ORB test pattern is bit i % 64 of word i / 64, which is byte for byte
/// the layout of OpenCV's and ORB-SLAM2's 32-byte descriptors on a little-endian machine.
struct Descriptor {
  std::array<std::uint64_t, 4> words{};
  bool operator==(const Descriptor&) const = default;
};
static_assert(sizeof(Descriptor) == 32);

/// Hamming distance, 0 to 256.
[[nodiscard]] inline int descriptor_distance(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a.words[0] ^ b.words[0]) + std::popcount(a.words[1] ^ b.words[1]) +
         std::popcount(a.words[2] ^ b.words[2]) + std::popcount(a.words[3] ^ b.words[3]);
}

}  // namespace cpslam
