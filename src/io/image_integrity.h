#pragma once

#include <string>
#include <string_view>

namespace cpslam {

/// What is wrong with the bytes of an image file, empty when they are a PNG, JPEG or TIFF whose structure is
/// complete. Decoders fill what a truncated file lacks with grey and call it a success, so this is looked at
/// first: PNG chunk by chunk up to IEND, JPEG marker by marker up to EOI (bytes after the end are allowed).
/// TIFF readers report missing data themselves.
[[nodiscard]] std::string image_integrity_error(std::string_view bytes);

}  // namespace cpslam
