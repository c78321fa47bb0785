#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace cpslam {

/// Makes the bytes of a binary file: numbers of named widths, little-endian whatever the machine is, nothing
/// padded.
class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void u32(std::uint32_t value) { append(value); }
  void u64(std::uint64_t value) { append(value); }
  void f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
  void f64(double value) { u64(std::bit_cast<std::uint64_t>(value)); }
  void raw(std::string_view bytes) { bytes_ += bytes; }

  [[nodiscard]] std::string take() { return std::exchange(bytes_, {}); }

 private:
  template <class Unsigned>
  void append(Unsigned value) {
    char bytes[sizeof value];
    for (char& byte : bytes) {
      byte = static_cast<char>(value & 0xFFU);
      value >>= 8U;
    }
    bytes_.append(bytes, sizeof bytes);
  }

  std::string bytes_;
};

}  // namespace cpslam
