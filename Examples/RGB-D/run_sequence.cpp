#include "run_sequence.h"

#include <array>
#include <cstdio>
#include <string>

#include "common/run_program.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "frame_pacer.h"
#include "io/image_reader.h"

namespace cpslam::program {
namespace {

constexpr std::size_t kReadAhead = 8;
constexpr std::size_t kMaxWarnings = 10;

/// Counts and names the frames that could not be used, the first few of them one by one.
class UnusableFrames {
 public:
  explicit UnusableFrames(ProgressBar& bar) : bar_(bar) {}
  void add(double time_s, const std::string& reason) {
    if (++count_ > kMaxWarnings) return;
    std::array<char, 32> stamp{};
    std::snprintf(stamp.data(), stamp.size(), "%.6f", time_s);
    bar_.print_line("warning: frame " + std::string(stamp.data()) + " left out: " + reason);
    if (count_ == kMaxWarnings) bar_.print_line("warning: further frames that are left out are only counted");
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  ProgressBar& bar_;
  std::size_t count_ = 0;
};

void track(System& system, const RgbdImages& images, PictureWriter* pictures) {
  RgbdFrame frame;
  frame.colour = images.colour;
  frame.depth = images.depth;
  frame.time_s = images.time_s;
  frame.depth_time_s = images.depth_time_s;
  system.track(frame);
  if (pictures != nullptr) pictures->add(images.colour, system.frame_view());
}

}  // namespace

int run_sequence(System& system, const std::vector<RgbdEntry>& entries, ProgressBar& bar,
                 PictureWriter* pictures, RunReport& report) {
  ReadAhead reader(entries, kReadAhead);
  UnusableFrames unusable(bar);
  FramePacer pacer;
  RgbdImages images;
  int exit_code = kExitOk;
  for (std::size_t done = 0; !stop_requested() && reader.next(images); bar.update(++done)) {
    report.sequence_s = images.time_s - entries.front().time_s;
    if (!images.error.empty()) {
      unusable.add(images.time_s, images.error);
      continue;
    }
    if (report.settings.realtime && !pacer.wait_for(images.time_s, 1.0 / report.settings.camera.fps)) {
      ++report.dropped;
      continue;
    }
    try {
      track(system, images, pictures);
    } catch (const InputError& error) {
      unusable.add(images.time_s, error.what());
    } catch (const std::exception& error) {
      bar.print_line(std::string("error: ") + error.what() + "; saving what was tracked");
      exit_code = kExitFailure;
      break;
    }
  }
  report.interrupted = stop_requested();
  report.unreadable = unusable.count();
  return report.unreadable > 0 ? kExitFailure : exit_code;
}

}  // namespace cpslam::program
