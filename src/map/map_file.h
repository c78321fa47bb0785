#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cpslam/settings.h"
#include "map/map_parts.h"

namespace cpslam {

/// What a map file holds (docs/map-format.md).
struct MapFile {
  CameraSettings camera;  ///< of it, the file has the size, the focal lengths, the centre and the distortion
  OrbSettings orb;        ///< of it, the pyramid
  std::optional<std::uint64_t> vocabulary;  ///< Vocabulary::identity() of the words the map was made with
  std::vector<MapParts> sessions;           ///< maps that nothing connects, each in a world of its own
};

/// Writes the file whole and onto the disk, or not at all: whatever happens, what stood there before or the
/// new map stands there. Throws RunError that names the file and the cause; a map that could not be loaded
/// again is refused.
void save_map_file(const std::string& path, const MapFile& map);

/// Reads a map for this camera and this pyramid. Throws InputError that names the file and what is wrong when
/// it is missing, no regular file, of another version, cut short, damaged, or was made with another camera.
[[nodiscard]] MapFile load_map_file(const std::string& path, const CameraSettings& camera,
                                    const OrbSettings& orb);

[[nodiscard]] std::string to_bytes(const MapFile& map);

/// Throws InputError that does not know the file.
[[nodiscard]] MapFile map_from_bytes(std::string_view bytes, const CameraSettings& camera,
                                     const OrbSettings& orb);

}  // namespace cpslam
