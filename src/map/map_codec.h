#pragma once

#include "camera/pinhole_camera.h"
#include "io/byte_reader.h"
#include "io/byte_writer.h"
#include "map/map_parts.h"

namespace cpslam {

/// The bytes of one session of a map file (docs/map-format.md).
void write_session(const MapParts& parts, ByteWriter& writer);

/// Throws InputError where the bytes are none; whether the parts make a map is for check() to say. camera: to
/// work out what of the features is not in the file.
[[nodiscard]] MapParts read_session(ByteReader& reader, const PinholeCamera& camera);

}  // namespace cpslam
