#include "common/stop_signal.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>

#include "cpslam/error.h"

namespace cpslam::program {
namespace {

// A signal handler can reach nothing but such objects.
volatile std::sig_atomic_t stop_flag = 0;
volatile std::sig_atomic_t wake_descriptor = -1;

void wake(int descriptor) {
  const std::uint64_t one = 1;
  (void)!write(descriptor, &one, sizeof one);  // an eventfd takes it, and a handler could not complain
}

extern "C" void request_stop(int signal) {
  const int saved_errno = errno;
  stop_flag = 1;
  if (wake_descriptor >= 0) wake(wake_descriptor);
  std::signal(signal, SIG_DFL);
  errno = saved_errno;
}

}  // namespace

void install_stop_signal() {
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

bool stop_requested() {
  return stop_flag != 0;
}

StopSignal::StopSignal()
    : wake_(eventfd(0, EFD_CLOEXEC)),
      watcher_([this](int&&, const std::stop_token&) { wait_for_wake(); }, 1) {
  if (wake_ < 0) throw RunError("cannot wait for Ctrl-C: too many open files");
  watcher_.push(0);
  watcher_.start();
  wake_descriptor = wake_;
  install_stop_signal();
}

StopSignal::~StopSignal() {
  wake_descriptor = -1;
  wake(wake_);
  watcher_.stop();
  close(wake_);
}

void StopSignal::wait_for_wake() {
  std::uint64_t count = 0;
  while (read(wake_, &count, sizeof count) < 0 && errno == EINTR) {
  }
  if (stop_requested()) source_.request_stop();
}

}  // namespace cpslam::program
