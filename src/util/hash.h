#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace cpslam {

/// 64-bit hash of bytes, against accidents and not against attackers: eight bytes at a time as a
/// little-endian word, each step a bijection of the state and of the word, so that damage within one word is
/// always noticed. Feeding pieces gives another hash than feeding the whole. The same on every platform.
class Hash {
 public:
  void add(std::span<const std::byte> bytes) {
    add_word(bytes.size());
    std::size_t i = 0;
    for (; i + sizeof(std::uint64_t) <= bytes.size(); i += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, sizeof word);
      add_word(word);
    }
    if (i == bytes.size()) return;
    std::uint64_t rest = 0;
    std::memcpy(&rest, bytes.data() + i, bytes.size() - i);
    add_word(rest);
  }
  /// The elements' bytes in memory: for types without padding.
  template <class T>
  void add_elements(std::span<const T> elements) {
    add(std::as_bytes(elements));
  }
  void add_word(std::uint64_t word) {
    state_ = (state_ ^ word) * 0x9E3779B97F4A7C15ULL;
    state_ ^= state_ >> 32U;
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243F6A8885A308D3ULL;
};

}  // namespace cpslam
