#pragma once

#include <span>
#include <string>
#include <string_view>

#include "io/byte_writer.h"
#include "map/map_file.h"
#include "support/synthetic.h"
#include "util/hash.h"

namespace cpslam::test {

/// A map file's body behind the header that belongs to it, as somebody could make it who means no good.
inline std::string with_header(std::string_view body) {
  Hash hash;
  hash.add(std::as_bytes(std::span(body)));
  ByteWriter writer;
  writer.raw("CPS-MAP\n");
  writer.u32(1);
  writer.u32(0);
  writer.u64(body.size());
  writer.u64(hash.value());
  writer.raw(body);
  return writer.take();
}

inline MapFile map_of(std::string_view bytes) {
  const Settings settings = synthetic::settings();
  return map_from_bytes(bytes, settings.camera, settings.orb);
}

}  // namespace cpslam::test
