#include "map/map_file.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "io/byte_writer.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "map/map_bytes.h"
#include "map/same_parts.h"
#include "map/some_map.h"

namespace cpslam {
namespace {

using test::map_of;
using test::some_map;
using testing::AllOf;
using testing::HasSubstr;

std::string load_error(const std::string& path) {
  const Settings settings = synthetic::settings();
  return input_error([&] { (void)load_map_file(path, settings.camera, settings.orb); });
}

TEST(MapFile, RoundTrip) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 40; seed < 44; ++seed) {
    MapFile map = some_map(seed);
    if (seed == 41) map.vocabulary.reset();
    if (seed == 42) map.sessions.push_back(test::later_parts(99, map.sessions[0]));
    save_map_file(folder.file("a.map"), map);
    const MapFile read = load_map_file(folder.file("a.map"), map.camera, map.orb);
    EXPECT_EQ(read.vocabulary, map.vocabulary);
    ASSERT_EQ(read.sessions.size(), map.sessions.size());
    for (std::size_t i = 0; i < map.sessions.size(); ++i)
      test::expect_same(read.sessions[i], map.sessions[i]);
    EXPECT_EQ(to_bytes(read), to_bytes(map));
  }
  EXPECT_EQ(folder.file_count(), 1U) << "nothing is left beside it";
}

TEST(MapFile, SessionsThatAreNotOfOneMapAreRefused) {
  MapFile twice = some_map();
  twice.sessions.push_back(twice.sessions[0]);
  EXPECT_THAT(input_error([&] { (void)map_of(to_bytes(twice)); }), HasSubstr("another one has"));
  MapFile turned = some_map();
  turned.sessions.insert(turned.sessions.begin(), test::later_parts(99, turned.sessions[0]));
  EXPECT_THAT(input_error([&] { (void)map_of(to_bytes(turned)); }), HasSubstr("session 1 comes before"));
}

TEST(MapFile, LoadedIntoAMapAndSavedAgainItIsTheSameToTheByte) {
  MapFile file = some_map();
  file.sessions[0].frames.clear();  // which a Map does not know
  Map map(synthetic::pyramid());
  map.assemble(map_of(to_bytes(file)).sessions[0]);
  MapFile again = file;
  again.sessions = {take_apart(map)};
  EXPECT_EQ(to_bytes(again), to_bytes(file));
}

TEST(MapFile, LayoutByHand) {
  MapFile map = some_map();
  MapParts& parts = map.sessions[0];
  parts = {};
  parts.keyframes_created = 3;
  parts.points_created = 5;
  parts.keyframes.push_back({2, 1.0, SE3(), test::blank_features(1)});
  MapParts::PointPart point;
  point.position_in_world = {1.0, 0.0, 2.0};
  point.reference = 0;
  point.observations = {{0, 0}};
  parts.points = {point};
  ByteWriter body;
  for (const double number : {640.0, 480.0, 525.0, 520.0, 319.5, 239.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.2, 8.0})
    body.f64(number);
  body.u8(1);
  body.u64(0x1122334455667788);
  body.u32(1);  // session
  body.u64(3);
  body.u64(5);
  body.u32(1);  // keyframe
  body.u64(2);
  body.f64(1.0);
  for (const double number : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0}) body.f64(number);
  body.u32(0xFFFFFFFF);
  body.u32(1);  // feature
  const FrameFeatures& features = *parts.keyframes[0].features;
  for (const float number : {0.0F, 0.0F, 0.0F, 50.0F}) body.f32(number);
  body.u8(0);
  for (const std::uint64_t word : features.descriptors[0].words) body.u64(word);
  body.f32(2.0F);
  body.f32(0.005F);
  body.u32(0);  // loops
  body.u32(1);  // point
  for (const double number : {1.0, 0.0, 2.0}) body.f64(number);
  body.u32(0);
  body.u64(0);
  body.u32(0);
  body.u32(0);
  body.u32(1);  // observation
  body.u32(0);
  body.u32(0);
  body.u32(0);  // frames
  const std::string bytes = to_bytes(map);
  EXPECT_EQ(bytes.substr(0, 16), std::string("CPS-MAP\n\1\0\0\0\0\0\0\0", 16));
  EXPECT_EQ(bytes.substr(32), body.take());
  EXPECT_EQ(bytes, test::with_header(bytes.substr(32)));
}

TEST(MapFile, WhatIsNoFileOfOurs) {
  const TemporaryFolder folder;
  EXPECT_THAT(load_error(folder.file("absent.map")),
              AllOf(HasSubstr("absent.map"), HasSubstr("No such file")));
  EXPECT_THAT(load_error(folder.path()), HasSubstr("no regular file"));
  EXPECT_THAT(load_error("/dev/zero"), HasSubstr("no regular file"));
  EXPECT_THAT(load_error(folder.write("empty.map", "")), HasSubstr("empty.map' is empty"));
  EXPECT_THAT(load_error(folder.write("a.png", "\x89PNG\r\n")),
              AllOf(HasSubstr("a.png'"), HasSubstr("no map")));
}

TEST(MapFile, AnotherVersion) {
  const TemporaryFolder folder;
  std::string bytes = to_bytes(some_map());
  bytes[8] = 2;
  EXPECT_THAT(load_error(folder.write("a.map", bytes)),
              AllOf(HasSubstr("version 2"), HasSubstr("reads version 1"), HasSubstr("make it again")));
}

TEST(MapFile, CutShortAtEveryByteOrTooLong) {
  const TemporaryFolder folder;
  const std::string bytes = to_bytes(some_map(7, 0));
  const Settings settings = synthetic::settings();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    const auto load = [&] {
      (void)map_from_bytes(std::string_view(bytes).substr(0, n), settings.camera, settings.orb);
    };
    ASSERT_THROW(load(), InputError) << n << " bytes";
  }
  EXPECT_THAT(load_error(folder.write("a.map", bytes.substr(0, bytes.size() / 2))), HasSubstr("cut short"));
  EXPECT_THAT(load_error(folder.write("a.map", bytes + "x")), HasSubstr("too long"));
}

TEST(MapFile, EveryDamagedByteIsNoticed) {
  const std::string bytes = to_bytes(some_map(7, 0));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    ASSERT_THROW((void)map_of(damaged), InputError) << "byte " << i;
  }
}

TEST(MapFile, CutShortAtEveryByteWithTheChecksumMadeToFit) {
  const std::string body = to_bytes(some_map(7, 0)).substr(32);
  for (std::size_t n = 0; n < body.size(); ++n) {
    ASSERT_THROW((void)map_of(test::with_header(body.substr(0, n))), InputError) << n << " bytes";
  }
  EXPECT_THAT(input_error([&] { (void)map_of(test::with_header(body + "x")); }), HasSubstr("goes on"));
}

TEST(MapFile, HugePromisesAreRefusedBeforeAnythingIsAllocated) {
  const std::string body = to_bytes(some_map(7, 0)).substr(32);
  // Number of sessions, of keyframes, of features.
  for (const std::size_t at : {113U, 133U, 253U}) {
    std::string huge = body;
    huge.replace(at, 4, 4, '\xFF');
    EXPECT_THAT(input_error([&] { (void)map_of(test::with_header(huge)); }), HasSubstr("promises more"))
        << at;
  }
}

TEST(MapFile, AnotherCameraIsRefusedByName) {
  const TemporaryFolder folder;
  const MapFile map = some_map();
  save_map_file(folder.file("a.map"), map);
  const auto error = [&](const auto& change) {
    Settings other = synthetic::settings();
    change(other);
    return input_error([&] { (void)load_map_file(folder.file("a.map"), other.camera, other.orb); });
  };
  EXPECT_THAT(error([](Settings& s) { s.camera.fx = 517.3; }),
              AllOf(HasSubstr("a.map'"), HasSubstr("another camera"), HasSubstr("Camera.fx is 525"),
                    HasSubstr("have 517.3")));
  EXPECT_THAT(error([](Settings& s) { s.camera.width = 320; }), HasSubstr("Camera.width is 640"));
  EXPECT_THAT(error([](Settings& s) { s.camera.k3 = 0.1; }), HasSubstr("Camera.k3 is 0, "));
  EXPECT_THAT(error([](Settings& s) { s.orb.n_levels = 7; }), HasSubstr("nLevels is 8"));
  EXPECT_THAT(error([](Settings& s) { s.orb.scale_factor = 1.3; }), HasSubstr("scaleFactor is 1.2"));
  Settings same = synthetic::settings();
  same.camera.fx += 1e-5;
  same.camera.fps = 5.0;
  same.camera.depth_map_factor = 1000.0;
  same.orb.n_features = 2000;
  EXPECT_NO_THROW((void)load_map_file(folder.file("a.map"), same.camera, same.orb));
}

TEST(MapFile, DisparitiesFollowTheSettings) {
  const TemporaryFolder folder;
  const MapFile map = some_map();
  save_map_file(folder.file("a.map"), map);
  CameraSettings other = map.camera;
  other.bf *= 2.0;
  const MapFile read = load_map_file(folder.file("a.map"), other, map.orb);
  const float before = map.sessions[0].keyframes[0].features->disparity_px[5];
  ASSERT_GT(before, 0.0F);
  EXPECT_FLOAT_EQ(read.sessions[0].keyframes[0].features->disparity_px[5], 2.0F * before);
}

TEST(MapFile, AMapThatIsNoneDoesNotReplaceOneThatIs) {
  const TemporaryFolder folder;
  MapFile map = some_map();
  save_map_file(folder.file("a.map"), map);
  map.sessions[0].points[0].position_in_world.x() = NAN;
  EXPECT_THAT(error_text<RunError>([&] { save_map_file(folder.file("a.map"), map); }),
              AllOf(HasSubstr("a.map"), HasSubstr("not sound"), HasSubstr("point 0")));
  EXPECT_EQ(TemporaryFolder::content(folder.file("a.map")), to_bytes(some_map()));
}

TEST(MapFile, AFullDiskLeavesTheOldMap) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  const TemporaryFolder folder;
  const std::string path = folder.file("a.map");
  save_map_file(path, some_map());
  std::filesystem::create_symlink("/dev/full", path + ".partial");
  EXPECT_THAT(error_text<RunError>([&] { save_map_file(path, some_map(8)); }), HasSubstr("No space left"));
  EXPECT_EQ(TemporaryFolder::content(path), to_bytes(some_map()));
}

}  // namespace
}  // namespace cpslam
