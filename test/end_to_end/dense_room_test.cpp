// The dense map of simulated rooms against their true surfaces, with people walking and sitting in them.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "cpslam/system.h"
#include "end_to_end/dense_truth.h"
#include "sim/simulation.h"

namespace cpslam::e2e {
namespace {

constexpr double kMaxGhostShare = 0.005;  // the project's aim

struct Room {
  const char* preset;
  int boxes_every;  ///< frames; 0: never, and nobody is looked for
  double min_completeness;
};

std::ostream& operator<<(std::ostream& stream, const Room& room) {
  return stream << room.preset << ", boxes every " << room.boxes_every << " frames";
}

sim::SimulationOptions sequence_of(const Room& room) {
  sim::SimulationOptions options;
  options.preset = room.preset;
  options.seed = 3;
  options.sensor_noise = true;
  options.n_frames = 150;
  return options;
}

struct Mapped {
  DenseMap map;
  std::vector<int> keyframes;
};

/// Boxes come with the frames, as from a detector that looks at some of them only.
Mapped map_of(const Room& room, sim::Simulation& simulation) {
  Settings settings = simulation.settings();
  settings.sequential = true;
  settings.vocabulary = CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc";
  settings.dense.enabled = true;
  System system(settings);
  std::vector<int> keyframes;
  for (int i = 0; i < simulation.size(); ++i) {
    const sim::SimulatedFrame seen = simulation.render(i);
    RgbdFrame frame;
    frame.colour = seen.colour_bgr;
    frame.depth = seen.depth;
    frame.time_s = seen.time_s;
    if (room.boxes_every > 0 && i % room.boxes_every == 0) frame.boxes = seen.boxes();
    const TrackResult result = system.track(frame);
    EXPECT_TRUE(is_tracked(result.state)) << i;
    if (result.keyframe) keyframes.push_back(i);
  }
  system.shutdown();
  return {system.dense_map(), keyframes};
}

class DenseRoom : public testing::TestWithParam<Room> {};

TEST_P(DenseRoom, IsTheRoomWithoutItsPeople) {
  const sim::SimulationOptions options = sequence_of(GetParam());
  sim::Simulation simulation(options);
  const auto [map, keyframes] = map_of(GetParam(), simulation);
  const DenseTruth truth(options, keyframes, DenseMapOptions().max_depth_m);
  // The map's world begins at the first frame's camera.
  const DenseScore score = truth.score(map.points(), simulation.world_from_camera(0));
  RecordProperty("views", std::to_string(map.n_views()));
  RecordProperty("points", std::to_string(score.points));
  RecordProperty("carved_voxels", std::to_string(map.n_carved_voxels()));
  RecordProperty("median_error_mm", std::to_string(1000.0 * score.median_error_m));
  RecordProperty("p95_error_mm", std::to_string(1000.0 * score.p95_error_m));
  RecordProperty("normal_error_deg", std::to_string(score.normal_error_deg));
  RecordProperty("off_percent", std::to_string(100.0 * score.off_share));
  RecordProperty("ghost_percent", std::to_string(100.0 * score.ghost_share));
  RecordProperty("completeness_percent", std::to_string(100.0 * score.completeness));
  EXPECT_GT(score.points, 10'000U);
  EXPECT_LT(score.median_error_m, 0.005);
  EXPECT_LT(score.off_share, 0.02);
  EXPECT_LT(score.normal_error_deg, 12.0);
  EXPECT_LE(score.ghost_share, kMaxGhostShare);
  EXPECT_GE(score.completeness, GetParam().min_completeness);
}

INSTANTIATE_TEST_SUITE_P(Simulated, DenseRoom,
                         testing::Values(Room{"office_xyz", 0, 0.9}, Room{"office_halfsphere", 0, 0.9},
                                         Room{"walking_static", 1, 0.6}, Room{"walking_xyz", 1, 0.6},
                                         Room{"walking_xyz", 6, 0.6}, Room{"walking_rpy", 6, 0.6},
                                         Room{"walking_halfsphere", 6, 0.6}, Room{"sitting_xyz", 6, 0.6},
                                         Room{"sitting_halfsphere", 1, 0.6}, Room{"ring_walking", 6, 0.6}),
                         [](const testing::TestParamInfo<Room>& test) {
                           return std::string(test.param.preset) + "_" +
                                  std::to_string(test.param.boxes_every);
                         });

}  // namespace
}  // namespace cpslam::e2e
