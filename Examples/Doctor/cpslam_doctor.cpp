// cpslam_doctor: tells what is wrong with RGB-D data before SLAM does.
#include <cstdio>
#include <optional>

#include "common/run_program.h"
#include "doctor_options.h"
#include "doctor_report.h"
#include "examine.h"
#include "io/atomic_file.h"

namespace cpslam::program {
namespace {

constexpr int kExitErrorsFound = 2;

int main_program(const DoctorOptions& options) {
  DoctorReport report = options.camera ? examine_camera(options) : examine_sequence(options);
  report.version = CPSLAM_VERSION;
  std::fputs(to_text(report).c_str(), stdout);
  if (!options.json.empty()) write_file_atomically(options.json, to_json(report));
  return worst_level(report.findings) == diagnosis::Level::kError ? kExitErrorsFound : kExitOk;
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  std::optional<int> result;
  const int exit_code = run_program("cpslam_doctor", [&] {
    std::optional<int> parsed;
    const DoctorOptions options = parse_command_line(argc, argv, parsed);
    if (!parsed) result = main_program(options);
    return parsed.value_or(kExitOk);
  });
  // Here 2 is for what was found; whatever else kept the program from looking is 1.
  return result ? *result : exit_code == kExitOk ? kExitOk : kExitFailure;
}
