// The map's lock must not starve its writer: readers that always overlap leave it no gap to slip in.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <vector>

#include "map/map_builder.h"

namespace cpslam {
namespace {

constexpr int kReaders = 2;
constexpr long kStarvedSections = 500000;

/// Two readers hand the lock to each other: neither lets go before the other has come in, unless that one
/// has to wait for a writer. With a lock that prefers readers the writer would wait for ever.
class OverlappingReaders {
 public:
  explicit OverlappingReaders(const Map& map) : map_(map) {
    for (int i = 0; i < kReaders; ++i)
      threads_.emplace_back([this](const std::stop_token& stop) { read(stop); });
  }
  [[nodiscard]] long sections() const { return sections_; }
  void writer_had_its_turn() { sections_at_last_write_ = sections_.load(); }
  [[nodiscard]] bool starved() const { return sections_ - sections_at_last_write_ > kStarvedSections; }

 private:
  void read(const std::stop_token& stop) {
    while (!stop.stop_requested() && !starved()) {
      const std::shared_lock lock(map_.mutex());
      const long mine = ++sections_;
      EXPECT_EQ(map_.n_keyframes(), 1U);
      // Not for ever: the other one may be waiting for a writer that waits for us.
      for (int spin = 0; spin < 1000 && sections_ == mine && !stop.stop_requested(); ++spin) {
        std::this_thread::yield();
      }
    }
  }

  const Map& map_;
  std::atomic<long> sections_ = 0;
  std::atomic<long> sections_at_last_write_ = 0;
  std::vector<std::jthread> threads_;
};

TEST(MapMutex, WriterGetsInBetweenReadersThatAlwaysOverlap) {
  Map map(synthetic::pyramid());
  const KeyFrameId id = test::add_keyframe(map, test::blank_features(1));
  OverlappingReaders readers(map);
  while (readers.sections() < 10) std::this_thread::yield();
  std::vector<long> sections_waited;
  for (int write = 0; write < 200; ++write) {
    const long before = readers.sections();
    {
      const std::unique_lock lock(map.mutex());
      sections_waited.push_back(readers.sections() - before);
      map.set_pose(id, {});
      readers.writer_had_its_turn();
    }
    ASSERT_FALSE(readers.starved());
    while (readers.sections() < before + kReaders + 1) std::this_thread::yield();
  }
  EXPECT_LE(*std::max_element(sections_waited.begin(), sections_waited.end()), kStarvedSections);
  // Between our look at the counter and our request others may run, but seldom.
  std::nth_element(sections_waited.begin(), sections_waited.begin() + 100, sections_waited.end());
  EXPECT_LE(sections_waited[100], 4 * kReaders);
}

}  // namespace
}  // namespace cpslam
