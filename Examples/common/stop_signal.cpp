#include "common/stop_signal.h"

#include <csignal>

namespace cpslam::program {
namespace {

// A signal handler can reach nothing but such an object.
volatile std::sig_atomic_t stop_flag = 0;

extern "C" void request_stop(int signal) {
  stop_flag = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void install_stop_signal() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

bool stop_requested() {
  return stop_flag != 0;
}

}  // namespace cpslam::program
