// The options of rgbd_tum that are about people: what goes together and what does not.
#include <gmock/gmock.h>

#include "io/temporary_folder.h"
#include "programs/program_run.h"

namespace cpslam {
namespace {

ProgramResult run_with(std::vector<std::string> options) {
  options.insert(options.begin(),
                 {"-", CPSLAM_SOURCE_DIR "/Examples/RGB-D/TUM1.yaml", "no_such_sequence", "--quiet"});
  return run_rgbd_tum(options);
}

/// Not a usage error: the run gets as far as the sequence that is not there.
void expect_understood(const std::vector<std::string>& options) {
  expect_refused(run_with(options), {"no_such_sequence"});
}

TEST(PeopleOptions, BoxesAndModelAreDetectorsOfTheirOwn) {
  expect_understood({"--boxes", "boxes.txt"});
  expect_understood({"--detector", "boxes", "--boxes", "boxes.txt"});
  expect_understood({"--model", "yc.cfg", "yc.weights"});
  expect_understood({"--detector", "yolo", "--model", "yc.cfg", "yc.weights"});
  expect_understood({"--detector", "none"});
}

TEST(PeopleOptions, DetectorsThatContradictTheirFiles) {
  expect_refused(run_with({"--detector", "psychic"}), {"--detector", "psychic", "yolo"});
  expect_refused(run_with({"--detector", "none", "--boxes", "b.txt"}), {"--boxes", "--detector none"});
  expect_refused(run_with({"--detector", "yolo", "--boxes", "b.txt"}), {"--boxes", "--detector yolo"});
  expect_refused(run_with({"--detector", "boxes", "--model", "a", "b"}), {"--model", "--detector boxes"});
  expect_refused(run_with({"--boxes", "b.txt", "--model", "a", "b"}), {"--boxes", "--model"});
  expect_refused(run_with({"--detector", "boxes"}), {"--detector boxes", "--boxes FILE"});
  expect_refused(run_with({"--model", "a"}), {"--model"});
}

TEST(PeopleOptions, OfTheNetwork) {
  expect_understood({"--model", "a", "b", "--classes", "0,2,15", "--quantise", "pictures"});
  expect_understood({"--model", "a", "b", "--classes", "7"});
  expect_refused(run_with({"--model", "a", "b", "--classes", "0,man"}), {"--classes", "man"});
  expect_refused(run_with({"--model", "a", "b", "--classes", "-1"}), {"--classes"});
  expect_refused(run_with({"--boxes", "b.txt", "--classes", "0"}), {"--classes", "--detector boxes"});
  expect_refused(run_with({"--boxes", "b.txt", "--quantise", "x"}), {"--quantise", "--detector boxes"});
  expect_refused(run_with({"--detector", "none", "--input-size", "320"}),
                 {"--input-size", "--detector none"});
  expect_understood({"--model", "a", "b", "--input-size", "320x256", "--confidence", "0.4", "--nms", "0.5",
                     "--detector-threads", "2"});
}

TEST(PeopleOptions, PretendingNeedsTheLatestPolicy) {
  const std::vector<std::string> pretended{"--boxes", "b.txt", "--boxes-rate", "6", "--boxes-delay", "0.15"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = pretended;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused(run_with(pretended), {"--boxes-rate", "--boxes-policy latest"});
  expect_refused(run_with(with({"--boxes-policy", "wait"})), {"--boxes-rate", "--boxes-policy latest"});
  expect_refused(run_with({"--boxes", "b.txt", "--boxes-delay", "1"}),
                 {"--boxes-delay", "--boxes-policy latest"});
  expect_understood(with({"--boxes-policy", "latest"}));
  expect_understood(with({"--realtime"}));
  expect_refused(run_with({"--boxes", "b", "--boxes-policy", "latest", "--boxes-rate", "-6"}),
                 {"--boxes-rate"});
  expect_refused(run_with({"--boxes", "b", "--boxes-policy", "later"}), {"--boxes-policy", "later"});
}

TEST(PeopleOptions, NothingToFilterWithoutADetector) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--people-filter", "paper"},
                                                  {"--no-reinstate"},
                                                  {"--save-boxes", "b.txt"},
                                                  {"--boxes-policy", "wait"}}) {
    std::vector<std::string> without = options;
    without.insert(without.end(), {"--detector", "none"});
    expect_refused(run_with(without), {options[0], "--boxes", "--model"});
    std::vector<std::string> with_boxes = options;
    with_boxes.insert(with_boxes.end(), {"--boxes", "b.txt"});
    expect_understood(with_boxes);
  }
  expect_refused(run_with({"--boxes", "b", "--people-filter", "magic"}), {"--people-filter", "magic", "sdf"});
}

}  // namespace
}  // namespace cpslam
