#include "doctor_options.h"

#include <CLI/CLI.hpp>
#include <vector>

#include "common/option_checks.h"
#include "common/run_program.h"
#include "common/size_option.h"

namespace cpslam::program {

DoctorOptions parse_command_line(int argc, char** argv, std::optional<int>& exit_code) {
  DoctorOptions options;
  std::vector<std::string> camera;
  CLI::App app{
      "Tells what is wrong with RGB-D data before SLAM does: depth scale, registration of depth to colour, "
      "time\n"
      "offset between them, frame rate and gaps, exposure, sharpness, share of valid depth, calibration, "
      "files,\n"
      "ground truth; each finding with its number and what to do.\n\n"
      "Examples:\n"
      "  cpslam_doctor ~/rgbd_dataset_freiburg1_desk Examples/RGB-D/TUM1.yaml\n"
      "  cpslam_doctor --camera\n"
      "  cpslam_doctor --camera recording.oni --json findings.json\n\n"
      "Exit status: 0 nothing serious, warnings included; 1 the data could not be looked at; 2 errors "
      "found."};
  app.add_option("SEQUENCE", options.sequence, "Folder with rgb.txt, depth.txt and the images");
  app.add_option(
      "SETTINGS", options.settings,
      "The camera's calibration (ORB-SLAM2's format); default settings.yaml in SEQUENCE, if there");
  CLI::Option* const from_camera =
      app.add_option(
             "--camera", camera,
             "Look at a camera, by its URI or a part of its name, or an .oni file; default the first camera")
          ->expected(0, 1)
          ->type_name("[NAME|FILE]");
  app.add_option("--settings", options.settings, "SETTINGS, for --camera; default what the camera says");
  add_size_option(app, "Options", options.width, options.height);
  app.add_option("--frames", options.n_frames,
                 "How many pairs to look at; of a longer sequence, stretches spread over it")
      ->check(check_positive_count)
      ->capture_default_str();
  app.add_option("--json", options.json, "Also write the findings here")->type_name("FILE");
  app.add_flag("--quiet", options.quiet, "No progress bar");
  app.set_version_flag("--version", "cpslam_doctor (CP-SLAM) " CPSLAM_VERSION);
  app.callback([&] {
    if (from_camera->count() > 0) options.camera = camera.empty() ? std::string() : camera.front();
    if (options.camera.has_value() != options.sequence.empty())
      throw CLI::ValidationError("SEQUENCE", "give a folder or --camera, one of them");
  });
  exit_code = parse(app, "cpslam_doctor", argc, argv);
  return options;
}

}  // namespace cpslam::program
