#include "map/map_file.h"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "camera/pinhole_camera.h"
#include "cpslam/error.h"
#include "io/atomic_file.h"
#include "io/byte_reader.h"
#include "io/byte_writer.h"
#include "io/input_file.h"
#include "io/settings_keys.h"
#include "map/map_codec.h"
#include "util/hash.h"

namespace cpslam {
namespace {

constexpr std::string_view kMagic = "CPS-MAP\n";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kMinSessionSize = 8 + 8 + 4 * 4;
// What settings files lose when they are printed and read again.
constexpr double kSameNumber = 1e-6;

std::uint64_t checksum(std::string_view bytes) {
  Hash hash;
  hash.add(std::as_bytes(std::span(bytes)));
  return hash.value();
}

struct CameraNumber {
  const char* key;  // as settings files spell it
  double value;
};

/// What two maps of one camera have in common.
std::array<CameraNumber, 13> numbers_of(const CameraSettings& camera, const OrbSettings& orb) {
  return {{{"Camera.width", static_cast<double>(camera.width)},
           {"Camera.height", static_cast<double>(camera.height)},
           {"Camera.fx", camera.fx},
           {"Camera.fy", camera.fy},
           {"Camera.cx", camera.cx},
           {"Camera.cy", camera.cy},
           {"Camera.k1", camera.k1},
           {"Camera.k2", camera.k2},
           {"Camera.p1", camera.p1},
           {"Camera.p2", camera.p2},
           {"Camera.k3", camera.k3},
           {"ORBextractor.scaleFactor", orb.scale_factor},
           {"ORBextractor.nLevels", static_cast<double>(orb.n_levels)}}};
}

void check_camera(ByteReader& reader, const CameraSettings& camera, const OrbSettings& orb) {
  for (const CameraNumber& here : numbers_of(camera, orb)) {
    const double there = reader.f64();
    if (std::abs(there - here.value) <= kSameNumber * std::max(1.0, std::abs(here.value))) continue;
    throw InputError("the map was made with another camera: its " + std::string(here.key) + " is " +
                     number_text(there) + ", the settings have " + number_text(here.value));
  }
}

/// What follows the header, when it is what was written.
std::string_view checked_body(std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) throw InputError("this is no map of CP-SLAM");
  ByteReader header(bytes.substr(kMagic.size()));
  if (const std::uint32_t version = header.u32(); version != kVersion) {
    throw InputError("the map is of version " + std::to_string(version) + ", this program reads version " +
                     std::to_string(kVersion) + ": make it again with this program");
  }
  if (header.u32() != 0) throw InputError("the map is damaged: its header is not as it should be");
  const std::uint64_t size = header.u64();
  const std::uint64_t sum = header.u64();
  const std::string_view body = header.rest();
  if (body.size() != size) {
    throw InputError("the map is " + std::string(body.size() < size ? "cut short" : "too long") + ": " +
                     std::to_string(body.size()) + " bytes follow its header, which promises " +
                     std::to_string(size));
  }
  if (checksum(body) != sum) throw InputError("the map is damaged: its checksum does not fit");
  return body;
}

MapFile read_sessions(ByteReader& reader, const CameraSettings& camera, const OrbSettings& orb) {
  MapFile map;
  map.camera = camera;
  map.orb = orb;
  const bool has_vocabulary = reader.u8() != 0;
  const std::uint64_t vocabulary = reader.u64();
  if (has_vocabulary) map.vocabulary = vocabulary;
  const PinholeCamera pinhole(camera);
  const std::size_t n_sessions = reader.count(kMinSessionSize);
  for (std::size_t i = 0; i < n_sessions; ++i) {
    map.sessions.push_back(read_session(reader, pinhole));
    // One by one, so that of many none takes memory once one is wrong.
    check(map.sessions.back(), orb.n_levels);
  }
  check_sequences(map.sessions);
  if (!reader.rest().empty()) throw InputError("it goes on after its end");
  return map;
}

}  // namespace

std::string to_bytes(const MapFile& map) {
  ByteWriter writer;
  for (const CameraNumber& number : numbers_of(map.camera, map.orb)) writer.f64(number.value);
  writer.u8(map.vocabulary ? 1 : 0);
  writer.u64(map.vocabulary.value_or(0));
  writer.u32(static_cast<std::uint32_t>(map.sessions.size()));
  for (const MapParts& session : map.sessions) write_session(session, writer);
  const std::string body = writer.take();
  writer.raw(kMagic);
  writer.u32(kVersion);
  writer.u32(0);
  writer.u64(body.size());
  writer.u64(checksum(body));
  writer.raw(body);
  return writer.take();
}

MapFile map_from_bytes(std::string_view bytes, const CameraSettings& camera, const OrbSettings& orb) {
  ByteReader reader(checked_body(bytes));
  check_camera(reader, camera, orb);
  try {
    return read_sessions(reader, camera, orb);
  } catch (const InputError& error) {
    throw InputError(std::string("the map is damaged: ") + error.what());
  }
}

void save_map_file(const std::string& path, const MapFile& map) {
  try {
    for (const MapParts& session : map.sessions) check(session, map.orb.n_levels);
    check_sequences(map.sessions);
  } catch (const InputError& error) {
    throw RunError("'" + path + "' was not written, the map is not sound: " + error.what());
  }
  write_file_atomically(path, to_bytes(map), Durability::kOnDisk);
}

MapFile load_map_file(const std::string& path, const CameraSettings& camera, const OrbSettings& orb) {
  const std::string bytes = read_regular_file(path, "map");
  try {
    return map_from_bytes(bytes, camera, orb);
  } catch (const InputError& error) {
    throw InputError("'" + path + "': " + error.what());
  }
}

}  // namespace cpslam
