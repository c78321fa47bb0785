#include "common/viewer_session.h"

#include <filesystem>
#include <memory>

#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "io/trajectory_io.h"
#include "util/thread_priority.h"
#include "util/worker.h"
#include "viewer/viewer.h"

namespace cpslam::program {
namespace {

Trajectory read_truth(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  try {
    return read_trajectory(path);
  } catch (const InputError&) {
    return {};  // SlamSession::finish() will say what is wrong with it
  }
}

viewer::ViewerOptions viewer_options(const SlamOptions& options, const ViewedRun& run) {
  viewer::ViewerOptions result;
  result.camera = run.settings.camera;
  result.truth = read_truth(run.ground_truth);
  result.can_pause = run.can_pause;
  result.localization = run.settings.localization;
  result.screenshot_folder = options.output;
  result.final_picture = options.viewer.final_picture;
  return result;
}

}  // namespace

void require_viewer() {}

int run_beside_viewer(const SlamOptions& options, const ViewedRun& run, SlamSession& session,
                      RunControl& control, const std::function<int()>& work) {
  if (!options.viewer.wanted()) return work();
  const auto board = std::make_shared<SnapshotBoard>();
  session.publish_to(board);
  int exit_code = 0;
  Worker<int> worker([&](int&&, const std::stop_token&) { exit_code = work(); }, 1);
  worker.start();
  // Where there is no graphics card the window is drawn by the cores that tracking needs. Said before the
  // driver starts threads of its own, and after the worker's was.
  give_way_to_other_threads();
  viewer::Viewer window(viewer_options(options, run), board, control);
  worker.push(0);
  try {
    window.run([&] { return worker.load() == 0; }, stop_requested);
  } catch (...) {
    control.quit();
    worker.wait_idle();
    throw;
  }
  worker.wait_idle();
  return exit_code;
}

}  // namespace cpslam::program
