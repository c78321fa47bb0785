// Damaged map files: an error or a map that works, never a crash (run under the sanitizers).
#include <gtest/gtest.h>

#include "cpslam/error.h"
#include "map/map_bytes.h"
#include "map/some_map.h"

namespace cpslam {
namespace {

constexpr int kTrials = 3000;

/// Turns over, overwrites, inserts, cuts out and repeats some bytes.
std::string damaged(std::string bytes, Random& random) {
  for (std::size_t n = 1 + random.index(3); n > 0 && !bytes.empty(); --n) {
    const std::size_t at = random.index(bytes.size());
    switch (random.index(8)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.insert(at, 1, static_cast<char>(random.next()));
        break;
      case 2:
        bytes.erase(at, random.index(100));
        break;
      case 3:
        bytes.insert(at, bytes.substr(random.index(bytes.size()), random.index(300)));
        break;
      case 4:
        bytes.replace(at, 4, 4, random.uniform() < 0.5 ? '\xFF' : '\0');
        break;
      case 5:  // another small number
        bytes[at] = static_cast<char>(random.index(6));
        break;
      default:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.index(8)));
    }
  }
  return bytes;
}

/// What the mapper may do to a map, all over it.
void work_with(Map& map, const MapParts& parts) {
  const std::vector<KeyFrameId> ids = map.assemble(parts);
  test::check_links(map);
  test::check_covisibility(map);
  for (const KeyFrameId id : ids) {
    map.update_covisibility(id);
    (void)map.best_covisible(id, 10);
    std::vector<int> near;
    map.keyframe(id)->features->grid.query(300.0F, 200.0F, 50.0F, 0, 7, near);
  }
  for (std::size_t i = 0; i < ids.size(); i += 2) map.erase_keyframe(ids[i]);
  const std::vector<MapPointId> points = map.point_ids();
  for (std::size_t i = 1; i < points.size(); i += 2) map.merge_points(points[i], points[i - 1]);
  for (const MapParts::FramePart& frame : parts.frames) {
    EXPECT_TRUE(map.cam_from_world(ids[frame.keyframe]).has_value());
  }
  test::check_links(map);
}

TEST(MapFuzz, DamagedFiles) {
  const std::string bytes = to_bytes(test::some_map(7, 100));
  Random random(17);
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string other = damaged(bytes, random);
    if (other == bytes) continue;
    EXPECT_THROW((void)test::map_of(other), InputError);
  }
}

TEST(MapFuzz, TheChecksumMadeToFit) {
  // An attacker can compute it: what then stands between him and the memory is the check of the parts.
  MapFile two = test::some_map(7, 200);
  two.sessions.push_back(test::later_parts(8, two.sessions[0]));
  const std::string body = to_bytes(two).substr(32);
  Random random(18);
  int valid = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    try {
      const MapFile file = test::map_of(test::with_header(damaged(body, random)));
      Map map(synthetic::pyramid());
      for (const MapParts& parts : file.sessions) work_with(map, parts);
      if (const std::vector<KeyFrameId> ids = map.keyframes_by_sequence(); !ids.empty())
        map.join_sessions(ids.front(), ids.back(), {});
      test::check_links(map);
      ++valid;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(valid, kTrials / 50) << "a changed bit of a descriptor makes another map";
  EXPECT_LT(valid, kTrials / 2);
}

/// Changes numbers that refer to something, which single bytes seldom hit.
void rewire(MapParts& parts, Random& random) {
  const auto any = [&] {
    const std::uint32_t choices[] = {0, 1,
                                     static_cast<std::uint32_t>(random.index(parts.keyframes.size() + 2)),
                                     static_cast<std::uint32_t>(random.next())};
    return choices[random.index(4)];
  };
  MapParts::PointPart& point = parts.points[random.index(parts.points.size())];
  switch (random.index(8)) {
    case 0:
      parts.keyframes[random.index(parts.keyframes.size())].parent = any();
      break;
    case 1:
      parts.loops.emplace_back(any(), any());
      break;
    case 2:
      point.reference = any();
      break;
    case 3:
      point.observations.push_back({any(), any()});
      break;
    case 4:
      point.observations[random.index(point.observations.size())] = {any(), any()};
      break;
    case 5:
      point = parts.points[random.index(parts.points.size())];
      break;
    case 6:
      parts.keyframes[random.index(parts.keyframes.size())].sequence = any();
      break;
    default:
      parts.frames[random.index(parts.frames.size())].keyframe = any();
  }
}

TEST(MapFuzz, ReferencesToAnything) {
  const MapFile whole = test::some_map(9, 300);
  Random random(19);
  int valid = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    MapFile map = whole;
    for (std::size_t n = 1 + random.index(2); n > 0; --n) rewire(map.sessions[0], random);
    try {
      Map in_memory(synthetic::pyramid());
      work_with(in_memory, test::map_of(to_bytes(map)).sessions[0]);
      ++valid;
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(valid, kTrials / 100);
  EXPECT_LT(valid, kTrials);
}

}  // namespace
}  // namespace cpslam
