#pragma once

#include "map/map_file.h"
#include "map/map_monkey.h"

namespace cpslam::test {

/// The parts of a map that a Monkey has been at, with loops and with frames that hang on its keyframes.
inline MapParts some_parts(std::uint64_t seed, int steps, bool lonely = false) {
  Monkey monkey(seed, lonely);
  for (int step = 0; step < steps; ++step) monkey.act();
  const auto ids = monkey.map.keyframes_by_sequence();
  for (std::size_t i = 3; i < ids.size(); i += 2) monkey.map.add_loop_edge(ids[i], ids[i - 3]);
  MapParts parts = take_apart(monkey.map);
  Random random(seed);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const SE3 pose(so3_exp({0.1 * random.uniform(), 0.0, 0.2}), {random.uniform(), 0.0, 1.0});
    parts.frames.push_back({100.0 + i / 30.0, i % static_cast<std::uint32_t>(ids.size()), pose});
  }
  return parts;
}

/// Parts of a session that was begun after the other one.
inline MapParts later_parts(std::uint64_t seed, const MapParts& earlier) {
  MapParts parts = some_parts(seed, 100);
  for (MapParts::KeyFramePart& keyframe : parts.keyframes) keyframe.sequence += earlier.keyframes_created;
  parts.keyframes_created += earlier.keyframes_created;
  return parts;
}

inline MapFile some_map(std::uint64_t seed = 7, int steps = 400) {
  MapFile map;
  map.camera = synthetic::settings().camera;
  map.orb = synthetic::settings().orb;
  map.vocabulary = 0x1122334455667788;
  map.sessions.push_back(some_parts(seed, steps));
  return map;
}

}  // namespace cpslam::test
