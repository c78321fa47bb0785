// What System lays down on a SnapshotBoard, and that it costs the result nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "cpslam/snapshot.h"
#include "cpslam/system.h"
#include "geometry/se3.h"
#include "slam/simulated_frames.h"
#include "support/same_trajectory.h"

namespace cpslam {
namespace {

using test::expect_same;
using test::SimulatedFrames;

TrackResult track_with_boxes(System& system, const SimulatedFrames& frames, std::size_t i) {
  const sim::SimulatedFrame& simulated = frames.frames[i];
  RgbdFrame frame;
  frame.colour = simulated.colour_bgr;
  frame.depth = simulated.depth;
  frame.time_s = simulated.time_s;
  frame.boxes = simulated.boxes();
  return system.track(frame);
}

void request_both(SnapshotBoard& board, SnapshotWish wish) {
  board.request_frame(wish);
  board.request_map(wish);
}

TEST(Snapshots, ShowTheFrameTheMapAndThePeople) {
  const SimulatedFrames frames(12, "walking_xyz");
  System system(frames.with_mode(true));
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  TrackResult last;
  for (std::size_t i = 0; i < 12; ++i) {
    request_both(*board, SnapshotWish::kEvery);
    last = track_with_boxes(system, frames, i);
  }
  const std::shared_ptr<const FrameSnapshot> frame = board->frame();
  const std::shared_ptr<const MapSnapshot> map = board->map();
  ASSERT_NE(frame, nullptr);
  ASSERT_NE(map, nullptr);
  EXPECT_EQ(frame->index, 11U);
  EXPECT_EQ(frame->result.time_s, last.time_s);
  EXPECT_EQ(frame->result.state, TrackingState::kTracked);
  EXPECT_EQ(static_cast<int>(frame->tracked_points.size()), last.n_inliers);
  EXPECT_EQ(cv::norm(frame->image, frames.frames[11].colour_bgr, cv::NORM_INF), 0.0);
  EXPECT_NE(frame->image.data, frames.frames[11].colour_bgr.data) << "a copy: the caller may reuse his";
  EXPECT_FALSE(frame->view.keypoints.empty());
  EXPECT_EQ(frame->view.boxes.size(), frames.frames[11].people.size());
  EXPECT_EQ(map->points.size(), system.statistics().map_points);
  EXPECT_EQ(map->keyframes.size(), system.statistics().keyframes);
  EXPECT_EQ(map->spanning_tree.size(), map->keyframes.size() - 1);
  expect_same(map->trajectory, system.trajectory());
  const auto tracked = std::find_if(frame->stages.begin(), frame->stages.end(),
                                    [](const StageTimes& stage) { return stage.stage == "track"; });
  ASSERT_NE(tracked, frame->stages.end());
  EXPECT_EQ(tracked->count, 12U);
  EXPECT_GE(tracked->total_ms, tracked->max_ms);
}

/// Share of a person's points that lie on his pixels of the frame's mask, at the depth that was measured
/// there.
double share_on_him(const PersonShape& person, const FrameSnapshot& frame, const cv::Mat& depth,
                    const CameraSettings& camera) {
  const SE3 cam_from_world = from_pose(frame.result.world_from_camera).inverse();
  int on_him = 0;
  for (const WorldPoint& p : person.surface) {
    const Eigen::Vector3d point = cam_from_world * Eigen::Vector3d(p[0], p[1], p[2]);
    const cv::Point px(static_cast<int>(std::lround(camera.fx * point.x() / point.z() + camera.cx)),
                       static_cast<int>(std::lround(camera.fy * point.y() / point.z() + camera.cy)));
    if (!cv::Rect({}, depth.size()).contains(px)) continue;
    const bool his = frame.view.person_mask.at<std::uint8_t>(px) == person.number;
    const double measured_m = depth.at<std::uint16_t>(px) / camera.depth_map_factor;
    if (his && std::abs(measured_m - point.z()) < 0.2) ++on_him;
  }
  return on_him / static_cast<double>(person.surface.size());
}

TEST(Snapshots, PeopleAreWhereTheCameraSawThem) {
  constexpr std::size_t kFrames = 12;
  const SimulatedFrames frames(static_cast<int>(kFrames), "sitting_xyz");
  System system(frames.with_mode(true));
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  board->request_frame(SnapshotWish::kEvery);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kFrames; ++i) {
    track_with_boxes(system, frames, i);
    const std::shared_ptr<const FrameSnapshot> frame = board->frame();
    for (const PersonShape& person : frame->people) {
      ASSERT_FALSE(person.surface.empty());
      EXPECT_GT(person.spacing_m, 0.005F);
      EXPECT_LT(person.spacing_m, 0.1F);
      if (person.hidden) continue;
      ++seen;
      EXPECT_GT(share_on_him(person, *frame, frames.frames[i].depth, frames.settings.camera), 0.8) << i;
    }
  }
  EXPECT_GE(seen, kFrames - 2);
}

TEST(Snapshots, ChangeNothingInASequentialRun) {
  const SimulatedFrames frames(40, "walking_xyz");
  System alone(frames.with_mode(true));
  System watched(frames.with_mode(true));
  const auto board = std::make_shared<SnapshotBoard>();
  watched.publish_to(board);
  for (std::size_t i = 0; i < 40; ++i) {
    track_with_boxes(alone, frames, i);
    // Every kind of request, and none.
    if (i % 3 == 1) request_both(*board, SnapshotWish::kWhenCheap);
    if (i % 3 == 2) request_both(*board, SnapshotWish::kEvery);
    track_with_boxes(watched, frames, i);
  }
  alone.shutdown();
  watched.shutdown();
  expect_same(alone.trajectory(), watched.trajectory());
  expect_same(alone.keyframe_trajectory(), watched.keyframe_trajectory());
  EXPECT_EQ(alone.statistics().map_points, watched.statistics().map_points);
}

TEST(Snapshots, TheWholeMapIsLaidDownAtTheEnd) {
  const SimulatedFrames frames(10);
  System system(frames.with_mode(false));
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  for (std::size_t i = 0; i < 10; ++i) frames.track(system, i);
  EXPECT_EQ(board->map(), nullptr) << "nobody asked";
  system.shutdown();
  ASSERT_NE(board->map(), nullptr);
  EXPECT_EQ(board->map()->points.size(), system.statistics().map_points);
  expect_same(board->map()->trajectory, system.trajectory());
  EXPECT_EQ(board->frame(), nullptr);
}

TEST(Snapshots, ABoardCanBeTakenAwayAndOutlivesItsSystem) {
  const SimulatedFrames frames(4);
  const auto board = std::make_shared<SnapshotBoard>();
  {
    System system(frames.with_mode(false));
    system.publish_to(board);
    request_both(*board, SnapshotWish::kEvery);
    frames.track(system, 0);
    system.publish_to(nullptr);
    request_both(*board, SnapshotWish::kEvery);
    frames.track(system, 1);
    EXPECT_EQ(board->frame()->index, 0U);
    system.shutdown();
  }
  EXPECT_GT(board->map()->points.size(), 0U);
}

TEST(Snapshots, AreConsistentWhileAllThreadsWork) {
  const SimulatedFrames frames(40);
  System system(frames.with_mode(false));
  const auto board = std::make_shared<SnapshotBoard>();
  system.publish_to(board);
  std::atomic<bool> done = false;
  std::size_t seen = 0;
  std::jthread viewer([&] {
    std::uint64_t last_index = 0;
    while (!done) {
      request_both(*board, SnapshotWish::kEvery);
      const std::shared_ptr<const FrameSnapshot> frame = board->frame();
      const std::shared_ptr<const MapSnapshot> map = board->map();
      if (frame != nullptr) {
        ASSERT_GE(frame->index, last_index);
        seen += frame->index > last_index ? 1U : 0U;
        last_index = frame->index;
        ASSERT_EQ(frame->image.rows, frames.settings.camera.height);
      }
      if (map != nullptr) {
        for (const auto* edges : {&map->covisibility, &map->spanning_tree, &map->loops}) {
          for (const KeyFrameEdge& edge : *edges) {
            ASSERT_LT(edge.from, map->keyframes.size());
            ASSERT_LT(edge.to, map->keyframes.size());
          }
        }
      }
      std::this_thread::yield();
    }
  });
  for (std::size_t i = 0; i < 40; ++i) ASSERT_EQ(frames.track(system, i).state, TrackingState::kTracked);
  done = true;
  viewer.join();
  system.shutdown();
  EXPECT_GT(seen, 0U);
  EXPECT_EQ(system.trajectory().size(), 40U);
}

}  // namespace
}  // namespace cpslam
