#include "place/bit_votes.h"

#include <gtest/gtest.h>

#include <array>

#include "place/small_tree.h"

namespace cpslam {
namespace {

bool bit(const Descriptor& descriptor, std::size_t i) {
  return ((descriptor.words[i / 64] >> (i % 64)) & 1U) != 0;
}

TEST(BitVotes, MajorityOfThreeByHand) {
  BitVotes votes;
  votes.add(test::bits(0b0111));
  votes.add(test::bits(0b0011));
  votes.add(test::bits(0b1001));
  EXPECT_EQ(votes.size(), 3U);
  EXPECT_EQ(votes.majority({}), test::bits(0b0011));
}

TEST(BitVotes, EqualVotesGoToTheUndecided) {
  BitVotes votes;
  votes.add(test::bits(0b1100));
  votes.add(test::bits(0b1010));
  EXPECT_EQ(votes.majority(test::bits(0b0000)), test::bits(0b1000));
  EXPECT_EQ(votes.majority(test::bits(0b0111)), test::bits(0b1110)) << "bit 0 has no vote";
}

TEST(BitVotes, SameAsCountingBitByBit) {
  Random random(5);
  for (std::size_t n = 1; n <= 70; ++n) {
    SCOPED_TRACE(n);
    BitVotes votes;
    std::array<std::size_t, 256> counts{};
    for (std::size_t k = 0; k < n; ++k) {
      // Sparse ones, so that the counters stay far below the half as well as about it.
      Descriptor descriptor = synthetic::random_descriptor(random);
      if (n % 3 == 0) descriptor.words[1] &= random.next() & random.next();
      if (n % 3 == 1) descriptor.words[2] = 0;
      votes.add(descriptor);
      for (std::size_t i = 0; i < 256; ++i) counts[i] += bit(descriptor, i) ? 1U : 0U;
    }
    const Descriptor undecided = synthetic::random_descriptor(random);
    const Descriptor majority = votes.majority(undecided);
    for (std::size_t i = 0; i < 256; ++i) {
      const bool expected = 2 * counts[i] == n ? bit(undecided, i) : 2 * counts[i] > n;
      ASSERT_EQ(bit(majority, i), expected) << "bit " << i;
    }
  }
}

}  // namespace
}  // namespace cpslam
