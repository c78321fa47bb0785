#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "common/picture_writer.h"
#include "common/progress_bar.h"
#include "common/run_report.h"
#include "common/slam_options.h"
#include "cpslam/snapshot.h"
#include "cpslam/system.h"
#include "detect/recording_detector.h"
#include "util/run_control.h"

namespace cpslam::program {

/// A System and what a program puts around it: messages, pictures, results. One thread at a time.
class SlamSession {
 public:
  /// Makes the output folder. The bar must outlive the session. Throws InputError for a folder or file that
  /// cannot be written, and what System throws.
  SlamSession(const SlamOptions& options, const Settings& settings, ProgressBar& bar);

  /// Tracks a frame and hands it to all who want to see it. Throws what System::track() throws. The images
  /// are not to be written to any more.
  TrackResult track(const RgbdFrame& frame);

  /// Does to the map what somebody at the screen wants; says so when it cannot be.
  void fulfil(const MapWishes& wishes);

  /// System::publish_to().
  void publish_to(std::shared_ptr<SnapshotBoard> board) { system_->publish_to(std::move(board)); }

  /// Writes the trajectories, those of dropped maps too, and the map where it is wanted, as they are now.
  /// False, with a message, when that fails.
  bool save_so_far();

  /// Ends the run and writes every result that can be written, one failure not costing the others. Fills what
  /// the report lacks: statistics, times and, when there is a file of that name, the error against
  /// ground_truth. Prints the summary. Returns an exit code.
  [[nodiscard]] int finish(const std::string& ground_truth, RunReport& report);

 private:
  bool attempt(const std::function<void()>& step) const;
  bool save_dropped_maps() const;
  bool save(const std::string& ground_truth, RunReport& report);
  bool save_dense_map(RunReport& report) const;
  void print_summary(const RunReport& report) const;

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const SlamOptions options_;
  ProgressBar& bar_;
  const LogSink log_;
  const RecordingDetector* recorder_ = nullptr;  // owned by the system; null when no boxes are saved
  std::unique_ptr<PictureWriter> pictures_;      // null when none are drawn
  std::unique_ptr<System> system_;
};

/// Says, unless quiet, that people are not looked for only because there is no network.
void note_missing_detector(const SlamOptions& options);

}  // namespace cpslam::program
