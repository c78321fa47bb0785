#include "map/slot_map.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "util/random.h"

namespace cpslam {
namespace {

struct Tag;
using Slots = SlotMap<std::string, Tag>;

TEST(SlotMap, FindsWhatWasInserted) {
  Slots slots;
  const auto a = slots.insert("a");
  const auto b = slots.insert("b");
  ASSERT_NE(slots.find(a), nullptr);
  EXPECT_EQ(*slots.find(a), "a");
  EXPECT_EQ(*slots.find(b), "b");
  EXPECT_EQ(slots.size(), 2U);
}

TEST(SlotMap, DefaultAndForeignIdsFindNothing) {
  Slots slots;
  slots.insert("a");
  EXPECT_FALSE(Slots::Id{}.valid());
  EXPECT_EQ(slots.find(Slots::Id{}), nullptr);
  EXPECT_EQ(slots.find({1, 0}), nullptr);
  EXPECT_EQ(slots.find({0, 1}), nullptr);
  EXPECT_FALSE(slots.erase({1, 0}));
}

TEST(SlotMap, ErasedIdStaysDeadWhenItsSlotIsUsedAgain) {
  Slots slots;
  const auto old = slots.insert("old");
  EXPECT_TRUE(slots.erase(old));
  EXPECT_FALSE(slots.erase(old));
  const auto heir = slots.insert("heir");
  EXPECT_EQ(heir.index, old.index);
  EXPECT_NE(heir, old);
  EXPECT_EQ(slots.find(old), nullptr);
  EXPECT_FALSE(slots.erase(old));
  EXPECT_EQ(*slots.find(heir), "heir");
}

TEST(SlotMap, ElementsKeepTheirAddress) {
  Slots slots;
  const auto id = slots.insert("here");
  const std::string* address = slots.find(id);
  for (int i = 0; i < 10000; ++i) slots.insert("more");
  EXPECT_EQ(slots.find(id), address);
}

TEST(SlotMap, EraseFreesTheElement) {
  SlotMap<std::shared_ptr<int>, Tag> slots;
  const auto value = std::make_shared<int>(1);
  const auto id = slots.insert(value);
  EXPECT_EQ(value.use_count(), 2);
  slots.erase(id);
  EXPECT_EQ(value.use_count(), 1);
}

TEST(SlotMap, IteratesByAscendingIndexOverTheLiving) {
  Slots slots;
  std::vector<Slots::Id> ids;
  for (int i = 0; i < 6; ++i) ids.push_back(slots.insert(std::to_string(i)));
  slots.erase(ids[4]);
  slots.erase(ids[1]);
  slots.insert("new");  // into the slot freed last
  std::vector<std::string> seen;
  const Slots& reader = slots;
  reader.for_each([&](Slots::Id id, const std::string& value) {
    EXPECT_EQ(slots.find(id), &value);
    seen.push_back(value);
  });
  EXPECT_EQ(seen, (std::vector<std::string>{"0", "new", "2", "3", "5"}));
}

TEST(SlotMap, AgreesWithAModelOverManyRandomSteps) {
  Random random(1);
  Slots slots;
  std::map<Slots::Id, std::string> living;
  std::vector<Slots::Id> dead;
  std::set<Slots::Id> ever;
  std::size_t most = 0;
  std::uint32_t highest_index = 0;
  for (int step = 0; step < 20000; ++step) {
    if (living.empty() || random.uniform() < 0.5) {
      const std::string value = std::to_string(step);
      const auto id = slots.insert(value);
      ASSERT_TRUE(ever.insert(id).second) << "an id came twice";
      living.emplace(id, value);
      highest_index = std::max(highest_index, id.index);
    } else {
      auto victim = living.begin();
      std::advance(victim, static_cast<std::ptrdiff_t>(random.index(living.size())));
      ASSERT_TRUE(slots.erase(victim->first));
      dead.push_back(victim->first);
      living.erase(victim);
    }
    most = std::max(most, living.size());
    ASSERT_EQ(slots.size(), living.size());
    if (!dead.empty()) {
      ASSERT_EQ(slots.find(dead[random.index(dead.size())]), nullptr);
    }
  }
  for (const auto& [id, value] : living) EXPECT_EQ(*slots.find(id), value);
  EXPECT_LT(highest_index, most) << "slots of the dead must be used again";
}

}  // namespace
}  // namespace cpslam
