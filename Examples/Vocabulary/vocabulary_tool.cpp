// vocabulary_tool: trains, converts and shows the vocabularies that places are recognised with.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "common/run_program.h"
#include "common/stop_signal.h"
#include "cpslam/error.h"
#include "picture_features.h"
#include "place/vocabulary_file.h"
#include "place/vocabulary_training.h"
#include "vocabulary_report.h"

namespace cpslam::program {
namespace {

struct ToolOptions {
  std::string input;
  std::string output;
  PictureSelection pictures;
  OrbSettings orb;
  VocabularyTrainingOptions training;
  bool quiet = false;
};

CLI::App* add_train(CLI::App& app, ToolOptions& options) {
  CLI::App* train = app.add_subcommand("train", "Train a vocabulary on pictures");
  train->add_option("OUTPUT", options.output, "The vocabulary to write")->required();
  train
      ->add_option("SOURCES", options.pictures.sources,
                   "Folders of pictures, sequences in TUM format, or lists (.txt) with a path a line")
      ->required();
  train->add_option("--branching", options.training.branching, "Children of a node")->capture_default_str();
  train->add_option("--levels", options.training.depth, "Levels of the tree")->capture_default_str();
  train->add_option("--every", options.pictures.every, "Of sequences, use every so many-th picture only")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  train->add_option("--features", options.orb.n_features, "Features of a picture, at most")
      ->check(CLI::Range(50, 100000))
      ->capture_default_str();
  train
      ->add_option("--max-features", options.training.max_features,
                   "Features that the tree is grown on, chosen at random from those of all pictures")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  train->add_option("--iterations", options.training.max_iterations, "Iterations for a node, at most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  train->add_option("--seed", options.training.seed, "Seed of every random draw")->capture_default_str();
  train->add_flag("--quiet", options.quiet, "No progress and no summary");
  return train;
}

int train(ToolOptions& options) {
  check_writable("OUTPUT", options.output);
  install_stop_signal();
  const std::vector<ImageDescriptors> images = extract_features(options.pictures, options.orb, options.quiet);
  constexpr std::size_t kSteps = 1000;
  ProgressBar bar("training", kSteps, !options.quiet);
  options.training.on_progress = [&bar](double share) {
    bar.update(static_cast<std::size_t>(share * static_cast<double>(kSteps)));
    return !stop_requested();
  };
  const Vocabulary vocabulary = train_vocabulary(images, options.training);
  bar.finish();
  save_vocabulary(options.output, vocabulary);
  std::size_t n_features = 0;
  for (const ImageDescriptors& image : images) n_features += image.size();
  if (!options.quiet) {
    std::cout << "pictures    " << images.size() << "\nfeatures    " << n_features << "\n"
              << to_text(vocabulary);
  }
  return kExitOk;
}

int convert(const ToolOptions& options) {
  check_writable("OUTPUT", options.output);
  const Vocabulary vocabulary = load_vocabulary(options.input);
  save_vocabulary(options.output, vocabulary);
  std::cout << to_text(vocabulary);
  return kExitOk;
}

int info(const ToolOptions& options) {
  const Vocabulary vocabulary = load_vocabulary(options.input);
  std::cout << "file        " << options.input << ", " << std::filesystem::file_size(options.input)
            << " bytes\n"
            << to_text(vocabulary);
  return kExitOk;
}

int main_program(int argc, char** argv) {
  ToolOptions options;
  CLI::App app{
      "Trains, converts and shows the vocabularies that places are recognised with.\n\n"
      "Examples:\n"
      "  vocabulary_tool train office.voc pictures/ rgbd_dataset_freiburg2_desk --every 10\n"
      "  vocabulary_tool convert ORBvoc.txt ORBvoc.voc\n"
      "  vocabulary_tool info ORBvoc.voc"};
  app.require_subcommand(1);
  const CLI::App* train_command = add_train(app, options);
  CLI::App* convert_command = app.add_subcommand(
      "convert", "Read a vocabulary, also the text of public ORB vocabularies, and write it in our format");
  convert_command->add_option("INPUT", options.input, "The vocabulary to read")->required();
  convert_command->add_option("OUTPUT", options.output, "The vocabulary to write")->required();
  CLI::App* info_command = app.add_subcommand("info", "Show what a vocabulary is like");
  info_command->add_option("FILE", options.input, "The vocabulary to read")->required();
  app.set_version_flag("--version", "vocabulary_tool (CP-SLAM) " CPSLAM_VERSION);
  if (const std::optional<int> exit_code = parse(app, "vocabulary_tool", argc, argv)) return *exit_code;
  if (train_command->parsed()) return train(options);
  return convert_command->parsed() ? convert(options) : info(options);
}

}  // namespace
}  // namespace cpslam::program

int main(int argc, char** argv) {
  using namespace cpslam::program;
  return run_program("vocabulary_tool", [&] { return main_program(argc, argv); });
}
