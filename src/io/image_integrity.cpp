#include "io/image_integrity.h"

#include <cstddef>

namespace cpslam {
namespace {

using std::string_view_literals::operator""sv;

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n"sv;
constexpr std::string_view kJpegStart = "\xFF\xD8\xFF"sv;
constexpr std::string_view kTiffLittleEndian = "II*\0"sv;
constexpr std::string_view kTiffBigEndian = "MM\0*"sv;

std::size_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

/// Chunks of length (4 bytes, big-endian), type (4 bytes), data, checksum (4 bytes); the last one is IEND.
bool png_is_complete(std::string_view bytes) {
  bytes.remove_prefix(kPngSignature.size());
  while (bytes.size() >= 12) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | byte_at(bytes, i);
    if (bytes.size() - 12 < length) return false;
    if (bytes.substr(4, 4) == "IEND") return true;
    bytes.remove_prefix(12 + length);
  }
  return false;
}

/// Segments of 0xFF, marker, length (2 bytes, big-endian, itself included), data. Entropy-coded data follows
/// a scan header; in it 0xFF is followed by 0 or a restart marker.
bool jpeg_is_complete(std::string_view bytes) {
  constexpr std::size_t kEndOfImage = 0xD9;
  constexpr std::size_t kStartOfScan = 0xDA;
  const auto is_restart = [](std::size_t marker) { return marker >= 0xD0 && marker <= 0xD7; };
  std::size_t i = 2;
  bool in_scan = false;
  while (true) {
    i = bytes.find('\xFF', i);
    if (i == std::string_view::npos) return false;
    while (i < bytes.size() && byte_at(bytes, i) == 0xFF) ++i;  // fill bytes
    if (i >= bytes.size()) return false;
    const std::size_t marker = byte_at(bytes, i++);
    if (marker == kEndOfImage) return true;
    if (is_restart(marker) || (marker == 0 && in_scan)) continue;
    if (bytes.size() - i < 2) return false;
    i += byte_at(bytes, i) << 8U | byte_at(bytes, i + 1);
    if (i >= bytes.size()) return false;
    in_scan = marker == kStartOfScan;
  }
}

}  // namespace

std::string image_integrity_error(std::string_view bytes) {
  constexpr const char* kTruncated = "is truncated: the end of the image is missing";
  if (bytes.starts_with(kPngSignature)) return png_is_complete(bytes) ? "" : kTruncated;
  if (bytes.starts_with(kJpegStart)) return jpeg_is_complete(bytes) ? "" : kTruncated;
  if (bytes.starts_with(kTiffLittleEndian) || bytes.starts_with(kTiffBigEndian)) return "";
  return "is not a PNG, JPEG or TIFF image";
}

}  // namespace cpslam
