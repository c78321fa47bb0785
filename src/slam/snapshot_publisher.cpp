#include "slam/snapshot_publisher.h"

#include <chrono>
#include <utility>

namespace cpslam {
namespace {

/// Milliseconds that an action takes.
template <typename Action>
double time_ms(const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool is_due(SnapshotWish wish, const TimeBudget& budget) {
  return wish == SnapshotWish::kEvery || (wish == SnapshotWish::kWhenCheap && budget.affordable());
}

}  // namespace

SnapshotPublisher::SnapshotPublisher(std::shared_ptr<SnapshotBoard> board, StageTimer& timer)
    : board_(std::move(board)), timer_(timer) {}

void SnapshotPublisher::offer(double tracking_ms, const MakeFrame& make_frame, const MakeMap& make_map) {
  frame_budget_.earn(tracking_ms);
  map_budget_.earn(tracking_ms);
  if (is_due(board_->map_wish(), map_budget_)) publish_map(make_map);
  if (is_due(board_->frame_wish(), frame_budget_)) publish_frame(make_frame);
}

void SnapshotPublisher::publish_map(const MakeMap& make_map) {
  const double cost_ms = time_ms([&] { board_->publish(std::make_shared<const MapSnapshot>(make_map())); });
  map_budget_.spend(cost_ms);
  timer_.add("viewer: snapshot of the map", cost_ms);
}

void SnapshotPublisher::publish_frame(const MakeFrame& make_frame) {
  const double cost_ms =
      time_ms([&] { board_->publish(std::make_shared<const FrameSnapshot>(make_frame())); });
  frame_budget_.spend(cost_ms);
  timer_.add("viewer: snapshot of the frame", cost_ms);
}

}  // namespace cpslam
