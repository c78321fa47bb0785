#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace cpslam {

/// 256-bit binary descriptor; bit i of the ORB test pattern is bit i % 64 of word i / 64, which is byte for
/// byte the layout of OpenCV's and ORB-SLAM2's 32-byte descriptors on a little-endian machine.
struct Descriptor {
  std::array<std::uint64_t, 4> words{};
  bool operator==(const Descriptor&) const = default;
};
static_assert(sizeof(Descriptor) == 32);

namespace detail {

/// Hamming distance word by word.
[[nodiscard]] inline int descriptor_distance_by_words(const Descriptor& a, const Descriptor& b) {
  return std::popcount(a.words[0] ^ b.words[0]) + std::popcount(a.words[1] ^ b.words[1]) +
         std::popcount(a.words[2] ^ b.words[2]) + std::popcount(a.words[3] ^ b.words[3]);
}

#if defined(__SSE2__)
/// The same, adding neighbouring fields of 1, 2 and 4 bits in parallel: baseline x86-64 has no popcnt
/// instruction, and the compiler's substitute is a call that looks up byte by byte.
[[nodiscard]] inline int descriptor_distance_sse2(const Descriptor& a, const Descriptor& b) {
  const auto difference = [&a, &b](std::size_t word) {
    return _mm_xor_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&a.words[word])),
                         _mm_loadu_si128(reinterpret_cast<const __m128i*>(&b.words[word])));
  };
  const __m128i every_2nd_bit = _mm_set1_epi8(0x55);
  const __m128i every_2nd_pair = _mm_set1_epi8(0x33);
  const __m128i every_2nd_nibble = _mm_set1_epi8(0x0F);
  const auto sums_of_4 = [&](__m128i v) {
    v = _mm_sub_epi8(v, _mm_and_si128(_mm_srli_epi64(v, 1), every_2nd_bit));
    return _mm_add_epi8(_mm_and_si128(v, every_2nd_pair),
                        _mm_and_si128(_mm_srli_epi64(v, 2), every_2nd_pair));
  };
  // A field of 4 bits holds at most 4 + 4, so both halves are added before going on to bytes.
  const __m128i nibbles = _mm_add_epi8(sums_of_4(difference(0)), sums_of_4(difference(2)));
  const __m128i bytes = _mm_add_epi8(_mm_and_si128(nibbles, every_2nd_nibble),
                                     _mm_and_si128(_mm_srli_epi64(nibbles, 4), every_2nd_nibble));
  const __m128i halves = _mm_sad_epu8(bytes, _mm_setzero_si128());
  return _mm_cvtsi128_si32(halves) + _mm_cvtsi128_si32(_mm_unpackhi_epi64(halves, halves));
}
#endif

}  // namespace detail

/// Hamming distance, 0 to 256.
[[nodiscard]] inline int descriptor_distance(const Descriptor& a, const Descriptor& b) {
#if defined(__SSE2__) && !defined(__POPCNT__)
  return detail::descriptor_distance_sse2(a, b);
#else
  return detail::descriptor_distance_by_words(a, b);
#endif
}

/// distances[i] = descriptor_distance(query, candidates[indices[i]]), with the processor's popcnt where it
/// has one: quicker than a loop over descriptor_distance. indices and distances are of equal length.
void descriptor_distances(const Descriptor& query, std::span<const Descriptor> candidates,
                          std::span<const int> indices, std::span<int> distances);

}  // namespace cpslam
