#include "support/virtual_display.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>

extern char** environ;  // NOLINT: POSIX wants every program to declare it itself

namespace cpslam::test {
namespace {

constexpr int kNumberFd = 3;  // in the server, which writes its display's number there
constexpr int kPatienceMs = 20000;

pid_t start_server(int number_fd) {
  std::array<std::string, 10> words{
      "Xvfb",     "-displayfd", std::to_string(kNumberFd), "-screen", "0", "1920x1200x24", "-nolisten", "tcp",
      "-noreset", "-ac"};
  std::array<char*, 11> argv{};
  for (std::size_t i = 0; i < words.size(); ++i) argv[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, number_fd, kNumberFd);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  const int error = posix_spawnp(&pid, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error == 0 ? pid : -1;
}

/// The display's name, from the line that the server writes when it is up; empty when it dies or takes too
/// long.
std::string read_name(int fd) {
  std::string name = ":";
  char letter = 0;
  while (true) {
    pollfd readable{fd, POLLIN, 0};
    if (poll(&readable, 1, kPatienceMs) <= 0 || read(fd, &letter, 1) != 1) return {};
    if (letter == '\n') return name;
    name += letter;
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
  // dup2 onto itself would leave the close-on-exec flag on.
  const int high = fcntl(ends[1], F_DUPFD_CLOEXEC, kNumberFd + 10);
  close(ends[1]);
  pid_ = start_server(high);
  close(high);
  const std::string name = pid_ > 0 ? read_name(ends[0]) : std::string();
  close(ends[0]);
  running_ = !name.empty();
  if (running_) setenv("DISPLAY", name.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (running_) unsetenv("DISPLAY");
  if (pid_ <= 0) return;
  kill(pid_, SIGTERM);
  waitpid(pid_, nullptr, 0);
}

}  // namespace cpslam::test
