#pragma once

#include <string>
#include <vector>

namespace cpslam {

/// What a program left behind.
struct ProgramResult {
  int exit_code = -1;    ///< of a program that ended by itself
  int ended_by = 0;      ///< the signal that ended it, 0 if none
  std::string out, err;  ///< all it wrote
};

/// A signal that is sent to the program once its stderr holds a text.
struct SignalAt {
  int signal = 0;
  std::string text;
};

/// Runs a program (a path and its arguments; no shell) to its end. Throws when it cannot be started or does
/// not end within a minute; it is killed then.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& command,
                                        const SignalAt& signal_at = {});

[[nodiscard]] ProgramResult run_rgbd_tum(const std::vector<std::string>& arguments,
                                         const SignalAt& signal_at = {});
[[nodiscard]] ProgramResult run_simulate_tum(const std::vector<std::string>& arguments);

/// Expects exit code 2, nothing on stdout and one line on stderr with all these words in it.
void expect_refused(const ProgramResult& result, const std::vector<std::string>& words);

[[nodiscard]] std::vector<std::string> lines_of(const std::string& text);

/// Lines that hold a text.
[[nodiscard]] std::size_t count_lines(const std::string& text, const std::string& part);

}  // namespace cpslam
