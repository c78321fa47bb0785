#pragma once

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace cpslam::program {

inline constexpr int kExitOk = 0;
inline constexpr int kExitFailure = 1;  ///< something failed while running
inline constexpr int kExitInput = 2;    ///< wrong usage or input

/// Parses the command line. An exit code when the program has nothing more to do: --help or --version was
/// asked for and is printed, or the usage is wrong and one line says how.
[[nodiscard]] std::optional<int> parse(CLI::App& app, const std::string& name, int argc, char** argv);

/// Runs a program's body and turns what it throws into one line on stderr and an exit code.
[[nodiscard]] int run_program(const std::string& name, const std::function<int()>& body);

}  // namespace cpslam::program
