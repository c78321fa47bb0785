#include "common/run_program.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "cpslam/error.h"

namespace cpslam::program {

std::optional<int> parse(CLI::App& app, const std::string& name, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s: %s; see --help\n", name.c_str(), error.what());
    return kExitInput;
  }
  return std::nullopt;
}

int run_program(const std::string& name, const std::function<int()>& body) {
  try {
    return body();
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return kExitInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    return kExitFailure;
  }
}

}  // namespace cpslam::program
