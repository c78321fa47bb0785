#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "cpslam/error.h"

namespace cpslam {

/// Reads what ByteWriter wrote. Every member throws InputError where the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint8_t u8() { return next<std::uint8_t>(); }
  [[nodiscard]] std::uint32_t u32() { return next<std::uint32_t>(); }
  [[nodiscard]] std::uint64_t u64() { return next<std::uint64_t>(); }
  [[nodiscard]] float f32() { return std::bit_cast<float>(u32()); }
  [[nodiscard]] double f64() { return std::bit_cast<double>(u64()); }

  /// Number (u32) of the elements that follow, none smaller than min_size bytes. More than the rest can hold
  /// are refused before anybody makes room for them.
  [[nodiscard]] std::size_t count(std::size_t min_size) {
    const std::size_t n = u32();
    if (n > bytes_.size() / min_size) throw InputError("it promises more than it holds");
    return n;
  }

  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  template <class Unsigned>
  Unsigned next() {
    if (bytes_.size() < sizeof(Unsigned)) throw InputError("it ends too early");
    Unsigned value = 0;
    for (std::size_t i = sizeof(Unsigned); i-- > 0;) {
      value = static_cast<Unsigned>(std::uint64_t{value} << 8U | static_cast<std::uint8_t>(bytes_[i]));
    }
    bytes_.remove_prefix(sizeof(Unsigned));
    return value;
  }

  std::string_view bytes_;
};

}  // namespace cpslam
