#include "end_to_end/clip.h"

#include <unistd.h>

#include <fstream>

#include "geometry/se3.h"

namespace cpslam::e2e {

Trajectory Clip::truth() const {
  Trajectory trajectory;
  for (const ClipFrame& frame : frames) trajectory.push_back({frame.time_s, frame.world_from_camera});
  return trajectory;
}

Clip render_clip(const sim::SimulationOptions& options) {
  sim::Simulation simulation(options);
  Clip clip;
  clip.settings = simulation.settings();
  clip.settings.sequential = true;
  clip.settings.vocabulary = CPSLAM_SOURCE_DIR "/Vocabulary/cpslam.voc";
  for (int i = 0; i < simulation.size(); ++i) {
    const sim::SimulatedFrame frame = simulation.render(i);
    clip.frames.push_back({frame.colour_bgr, frame.depth, frame.time_s, to_pose(frame.world_from_camera)});
  }
  return clip;
}

std::vector<TrackResult> track_all(System& system, const Clip& clip) {
  std::vector<TrackResult> results;
  for (const ClipFrame& frame : clip.frames)
    results.push_back(system.track(frame.colour, frame.depth, frame.time_s));
  return results;
}

double position_error_m(const TrackResult& result, const ClipFrame& frame, const ClipFrame& first) {
  const SE3 first_from_camera =
      from_pose(first.world_from_camera).inverse() * from_pose(frame.world_from_camera);
  return (from_pose(result.world_from_camera).translation - first_from_camera.translation).norm();
}

double resident_memory_mb() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0, resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

}  // namespace cpslam::e2e
