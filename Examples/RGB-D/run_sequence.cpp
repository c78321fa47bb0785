#include "run_sequence.h"

#include <string>

#include "common/left_out.h"
#include "common/run_program.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "frame_pacer.h"
#include "io/image_reader.h"
#include "io/text_table.h"

namespace cpslam::program {
namespace {

constexpr std::size_t kReadAhead = 8;

void track(SlamSession& session, const RgbdImages& images) {
  RgbdFrame frame;
  frame.colour = images.colour;
  frame.depth = images.depth;
  frame.time_s = images.time_s;
  frame.depth_time_s = images.depth_time_s;
  session.track(frame);
}

}  // namespace

int run_sequence(SlamSession& session, const std::vector<RgbdEntry>& entries, RunControl& control,
                 ProgressBar& bar, RunReport& report) {
  ReadAhead reader(entries, kReadAhead);
  LeftOut unusable("frame", bar);
  FramePacer pacer;
  RgbdImages images;
  int exit_code = kExitOk;
  for (std::size_t done = 0; !stop_requested() && reader.next(images); bar.update(++done)) {
    report.sequence_s = images.time_s - entries.front().time_s;
    if (!images.error.empty()) {
      unusable.add(stamp_text(images.time_s), images.error);
      continue;
    }
    const auto paused = control.wait_for_turn();
    if (!paused) break;
    pacer.delay(*paused);
    session.fulfil(control.take_wishes());
    if (report.settings.realtime && !pacer.wait_for(images.time_s, 1.0 / report.settings.camera.fps)) {
      ++report.dropped;
      continue;
    }
    try {
      track(session, images);
    } catch (const InputError& error) {
      unusable.add(stamp_text(images.time_s), error.what());
    } catch (const std::exception& error) {
      bar.print_line(std::string("error: ") + error.what() + "; saving what was tracked");
      exit_code = kExitFailure;
      break;
    }
  }
  report.interrupted = stop_requested() || control.quitting();
  report.unreadable = unusable.count();
  return report.unreadable > 0 ? kExitFailure : exit_code;
}

}  // namespace cpslam::program
