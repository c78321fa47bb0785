#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/descriptor.h"

namespace cpslam {

/// Counts, for each of the 256 bits, how many descriptors have it set. The counters lie across: plane p holds
/// bit p of all 256 counters, so that one addition is a few operations on whole words.
class BitVotes {
 public:
  void add(const Descriptor& descriptor) {
    ++n_;
    std::array<std::uint64_t, 4> carry = descriptor.words;
    for (Plane& plane : planes_) {
      std::uint64_t any = 0;
      for (std::size_t w = 0; w < 4; ++w) {
        const std::uint64_t both = plane[w] & carry[w];
        plane[w] ^= carry[w];
        carry[w] = both;
        any |= both;
      }
      if (any == 0) return;
    }
    planes_.push_back(carry);
  }

  [[nodiscard]] std::size_t size() const { return n_; }

  /// The median in Hamming space: every bit as most descriptors have it; where the votes are equal, as
  /// `undecided` has it.
  [[nodiscard]] Descriptor majority(const Descriptor& undecided) const {
    const std::size_t half = n_ / 2;
    Descriptor result;
    for (std::size_t w = 0; w < 4; ++w) {
      std::uint64_t more = 0;
      std::uint64_t equal = ~std::uint64_t{0};
      for (std::size_t p = planes_.size(); p-- > 0;) {
        const std::uint64_t bit_of_half = ((half >> p) & 1U) != 0 ? ~std::uint64_t{0} : 0;
        more |= equal & planes_[p][w] & ~bit_of_half;
        equal &= ~(planes_[p][w] ^ bit_of_half);
      }
      // half may need a plane more than any counter has: then no counter reaches it.
      if ((half >> planes_.size()) != 0) more = equal = 0;
      if (n_ % 2 != 0) equal = 0;
      result.words[w] = more | (equal & undecided.words[w]);
    }
    return result;
  }

 private:
  using Plane = std::array<std::uint64_t, 4>;
  std::vector<Plane> planes_;
  std::size_t n_ = 0;
};

}  // namespace cpslam
