// Accuracy in a simulated room with nobody in it.
#include <gtest/gtest.h>

#include <ostream>

#include "end_to_end/clip.h"
#include "io/trajectory_error.h"

namespace cpslam::e2e {
namespace {

constexpr int kFrames = 100;
// The bounds of the project's aims.
constexpr double kExactDepthBoundM = 0.005;
constexpr double kNoisyDepthBoundM = 0.012;

struct Office {
  const char* preset;
  bool sensor_noise;
  bool sequential;
};

std::ostream& operator<<(std::ostream& stream, const Office& office) {
  return stream << office.preset << (office.sensor_noise ? " with noise" : "");
}

class StaticOffice : public testing::TestWithParam<Office> {};

TEST_P(StaticOffice, EveryFrameTrackedAndAccurate) {
  sim::SimulationOptions options;
  options.preset = GetParam().preset;
  options.sensor_noise = GetParam().sensor_noise;
  options.n_frames = kFrames;
  options.seed = 1;
  Clip clip = render_clip(options);
  clip.settings.sequential = GetParam().sequential;
  System system(clip.settings);
  static_cast<void>(track_all(system, clip));
  system.shutdown();
  EXPECT_EQ(system.statistics().tracked, clip.frames.size());
  const TrajectoryError error = absolute_trajectory_error(clip.truth(), system.trajectory());
  RecordProperty("ate_rmse_m", std::to_string(error.rmse_m));
  EXPECT_EQ(error.pairs, clip.frames.size());
  EXPECT_GT(error.rmse_m, 0.0);
  EXPECT_LE(error.rmse_m, GetParam().sensor_noise ? kNoisyDepthBoundM : kExactDepthBoundM);
}

INSTANTIATE_TEST_SUITE_P(Simulated, StaticOffice,
                         testing::Values(Office{"office_static", false, true},
                                         Office{"office_static", true, true},
                                         Office{"office_xyz", false, true}, Office{"office_xyz", true, true},
                                         Office{"office_rpy", false, true}, Office{"office_rpy", true, true},
                                         Office{"office_halfsphere", false, true},
                                         Office{"office_halfsphere", true, true},
                                         Office{"office_xyz", true, false}),
                         [](const testing::TestParamInfo<Office>& test) {
                           return std::string(test.param.preset) + (test.param.sensor_noise ? "_noise" : "") +
                                  (test.param.sequential ? "" : "_threads");
                         });

}  // namespace
}  // namespace cpslam::e2e
