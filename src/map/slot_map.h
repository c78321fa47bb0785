#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace cpslam {

/// Typed handle into a SlotMap. A default-constructed id refers to nothing; the id of an erased element never
/// comes back to life, because its slot's generation has moved on.
template <class Tag>
struct SlotId {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t index = kNone;
  std::uint32_t generation = 0;

  [[nodiscard]] bool valid() const { return index != kNone; }
  auto operator<=>(const SlotId&) const = default;
};

/// Generational slot map: O(1) insert, look-up and erase without hashing; elements keep their address; the
/// slots of erased elements are used again, so memory follows the number of live elements. Iteration is by
/// slot index, which makes it reproducible. Not thread-safe.
template <class T, class Tag>
class SlotMap {
 public:
  using Id = SlotId<Tag>;

  Id insert(T value) {
    std::uint32_t index = 0;
    if (free_.empty()) {
      index = static_cast<std::uint32_t>(slots_.size());
      slots_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    slots_[index].value.emplace(std::move(value));
    return {index, slots_[index].generation};
  }

  bool erase(Id id) {
    if (find(id) == nullptr) return false;
    Slot& slot = slots_[id.index];
    slot.value.reset();
    ++slot.generation;
    free_.push_back(id.index);
    return true;
  }

  [[nodiscard]] T* find(Id id) {
    if (id.index >= slots_.size()) return nullptr;
    Slot& slot = slots_[id.index];
    return slot.generation == id.generation && slot.value.has_value() ? &*slot.value : nullptr;
  }
  [[nodiscard]] const T* find(Id id) const { return const_cast<SlotMap*>(this)->find(id); }

  /// Calls visit(Id, T&) for every live element, by ascending slot index.
  template <class Visit>
  void for_each(Visit visit) {
    for (std::uint32_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i].value.has_value()) visit(Id{i, slots_[i].generation}, *slots_[i].value);
    }
  }
  template <class Visit>
  void for_each(Visit visit) const {
    const_cast<SlotMap*>(this)->for_each([&](Id id, const T& value) { visit(id, value); });
  }

  [[nodiscard]] std::size_t size() const { return slots_.size() - free_.size(); }

 private:
  struct Slot {
    std::uint32_t generation = 0;
    std::optional<T> value;
  };
  std::deque<Slot> slots_;
  std::vector<std::uint32_t> free_;
};

}  // namespace cpslam
