// Somebody kills the program while it saves a map.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "io/temporary_folder.h"
#include "map/some_map.h"

namespace cpslam {
namespace {

constexpr int kRounds = 100;

/// Some megabytes, so that a good part of the time goes into writing.
MapFile large_map(std::uint64_t vocabulary) {
  MapFile map = test::some_map();
  map.vocabulary = vocabulary;
  MapParts& parts = map.sessions[0];
  const auto features = test::blank_features(2000);
  for (int i = 0; i < 20; ++i)
    parts.keyframes.push_back({parts.keyframes_created++, 1.0, SE3(), features, 0});
  return map;
}

[[noreturn]] void save_for_ever(const std::string& path, const MapFile& one, const MapFile& other) {
  try {
    for (;;) {
      save_map_file(path, one);
      save_map_file(path, other);
    }
  } catch (...) {
    _exit(1);
  }
}

TEST(MapKill, TheOldOrTheNewMapLoadsAlways) {
  const TemporaryFolder folder;
  const std::string path = folder.file("room.map");
  const MapFile one = large_map(1);
  const MapFile other = large_map(2);
  save_map_file(path, one);
  Random random(5);
  int in_the_middle = 0;
  int changed = 0;
  std::uint64_t last = 1;
  for (int round = 0; round < kRounds; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) save_for_ever(path, one, other);
    std::this_thread::sleep_for(std::chrono::microseconds(random.index(60000)));
    ASSERT_EQ(kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it could not save";
    if (std::filesystem::exists(path + ".partial")) ++in_the_middle;
    const MapFile found = load_map_file(path, one.camera, one.orb);
    ASSERT_TRUE(found.vocabulary == 1U || found.vocabulary == 2U);
    ASSERT_EQ(to_bytes(found), to_bytes(found.vocabulary == 1U ? one : other));
    if (*found.vocabulary != last) ++changed;
    last = *found.vocabulary;
  }
  RecordProperty("killed_in_the_middle", in_the_middle);
  RecordProperty("found_the_other_map", changed);
  std::printf("%d kills: %d left an unfinished file beside the map, %d times the map was another one\n",
              kRounds, in_the_middle, changed);
  EXPECT_NO_THROW(save_map_file(path, one)) << "what lies about from before does not disturb";
  EXPECT_EQ(folder.file_count(), 1U);
}

}  // namespace
}  // namespace cpslam
