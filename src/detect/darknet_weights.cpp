#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "cpslam/error.h"
#include "detect/darknet_network.h"

// A .weights file: three int32 (major, minor, revision), the number of pictures seen in training (64 bits
// from version 0.2 on, 32 before), then the weights of all layers as floats. Little-endian, as we are.

namespace cpslam {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kVersionBytes = 3 * sizeof(std::int32_t);

template <typename T>
T read_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

std::size_t header_bytes(const std::string& bytes, const std::string& path) {
  if (bytes.size() < kVersionBytes) {
    throw InputError("'" + path + "' has " + std::to_string(bytes.size()) +
                     " bytes: too short for a Darknet .weights file");
  }
  const auto major = read_at<std::int32_t>(bytes, 0);
  const auto minor = read_at<std::int32_t>(bytes, sizeof(std::int32_t));
  if (major < 0 || major > 99 || minor < 0 || minor > 99) {
    throw InputError("'" + path + "' is not a Darknet .weights file: its version reads " +
                     std::to_string(major) + "." + std::to_string(minor));
  }
  return kVersionBytes + (major * 10 + minor >= 2 ? sizeof(std::int64_t) : sizeof(std::int32_t));
}

}  // namespace

void check_darknet_weights(const std::string& bytes, const std::string& weights_path,
                           const DarknetNetwork& network, const std::string& config_path) {
  const std::size_t header = header_bytes(bytes, weights_path);
  const std::size_t expected = header + network.n_weights * sizeof(float);
  if (bytes.size() != expected) {
    throw InputError("'" + weights_path + "' has " + std::to_string(bytes.size()) + " bytes, but '" +
                     config_path + "' asks for " + std::to_string(expected) + ": " +
                     (bytes.size() < expected ? "it was cut off, or" : "something was added, or") +
                     " the two do not belong together");
  }
  for (std::size_t at = header; at < bytes.size(); at += sizeof(float)) {
    if (std::isfinite(read_at<float>(bytes, at))) continue;
    throw InputError("'" + weights_path + "' is damaged: the number at byte " + std::to_string(at) +
                     " is not finite");
  }
}

}  // namespace cpslam
