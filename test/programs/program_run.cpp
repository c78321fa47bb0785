#include "programs/program_run.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <sstream>
#include <stdexcept>

extern char** environ;  // NOLINT: POSIX wants every program to declare it itself

namespace cpslam {
namespace {

constexpr std::chrono::seconds kLongestRun{60};

/// Reads from one of the program's streams.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  [[nodiscard]] int reading() const { return ends_[0]; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  void close_writing() { close_end(1); }
  /// Appends what there is; at the end closes the pipe, so that reading() is -1.
  void read_into(std::string& text) {
    std::array<char, 4096> buffer{};
    const ssize_t n = read(ends_[0], buffer.data(), buffer.size());
    if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) close_end(0);
  }

 private:
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

pid_t start(const std::vector<std::string>& command, const Pipe& out, const Pipe& err) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.writing(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.writing(), STDERR_FILENO);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0 || pid <= 0) throw std::runtime_error("cannot start " + command.at(0));
  return pid;
}

int wait_for_end(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("waitpid failed");
  }
  return status;
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const SignalAt& signal_at) {
  Pipe out, err;
  const pid_t pid = start(command, out, err);
  out.close_writing();
  err.close_writing();
  ProgramResult result;
  bool to_signal = signal_at.signal != 0;
  const auto deadline = std::chrono::steady_clock::now() + kLongestRun;
  while (out.reading() >= 0 || err.reading() >= 0) {
    std::array<pollfd, 2> streams{pollfd{out.reading(), POLLIN, 0}, pollfd{err.reading(), POLLIN, 0}};
    poll(streams.data(), streams.size(), 1000);
    if (streams[0].revents != 0) out.read_into(result.out);
    if (streams[1].revents != 0) err.read_into(result.err);
    if (to_signal && result.err.find(signal_at.text) != std::string::npos) {
      kill(pid, signal_at.signal);
      to_signal = false;
    }
    if (std::chrono::steady_clock::now() > deadline) {
      kill(pid, SIGKILL);
      wait_for_end(pid);
      throw std::runtime_error(command[0] + " did not end; it wrote: " + result.err);
    }
  }
  const int status = wait_for_end(pid);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.ended_by = WTERMSIG(status);
  return result;
}

ProgramResult run_rgbd_tum(const std::vector<std::string>& arguments, const SignalAt& signal_at) {
  std::vector<std::string> command{RGBD_TUM_PATH};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command, signal_at);
}

ProgramResult run_simulate_tum(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{SIMULATE_TUM_PATH};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

void expect_refused(const ProgramResult& result, const std::vector<std::string>& words) {
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.ended_by, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  for (const std::string& word : words) EXPECT_THAT(result.err, testing::HasSubstr(word));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::size_t count_lines(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (const std::string& line : lines_of(text)) count += line.find(part) != std::string::npos ? 1U : 0U;
  return count;
}

}  // namespace cpslam
