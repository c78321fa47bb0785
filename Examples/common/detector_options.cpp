#include "common/detector_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <functional>

#include "common/setting_names.h"
#include "cpslam/person_detector.h"

namespace cpslam::program {
namespace {

constexpr std::array kKinds{DetectorKind::kNone, DetectorKind::kBoxes, DetectorKind::kYolo};
constexpr std::array kPolicies{BoxesPolicy::kWait, BoxesPolicy::kLatest};
constexpr std::array kFilters{PeopleFilter::kSdf, PeopleFilter::kPaper, PeopleFilter::kBoxes};

/// An option that takes one of the names of an enumeration's values.
template <typename Value, std::size_t size>
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::optional<Value>& target,
                        const std::array<Value, size>& values, const std::string& help) {
  std::string choices;
  for (const Value value : values) choices += (choices.empty() ? "" : "|") + std::string(name_of(value));
  const std::function<void(const std::string&)> take = [&target, values, name,
                                                        choices](const std::string& text) {
    for (const Value value : values) {
      if (text == name_of(value)) target = value;
    }
    if (!target) throw CLI::ValidationError(name, "'" + text + "' is none of " + choices);
  };
  return app.add_option_function(name, take, help)->type_name(choices);
}

[[noreturn]] void refuse(const std::string& option, const std::string& why) {
  throw CLI::ValidationError(option, why);
}

std::string default_text() {
  const std::optional<DetectorModel> bundled = bundled_detector_model();
  return bundled
             ? "Default boxes with --boxes, else yolo with --model or the network that comes with "
               "CP-SLAM,\n'" +
                   bundled->weights + "'"
             : "Default boxes with --boxes, yolo with --model, else none: there is no network to run, for\n" +
                   no_bundled_detector_model_text();
}

void add_detector_group(CLI::App& app, DetectorOptions& options) {
  const std::string group = "People: where they are";
  add_choice(app, "--detector", options.kind, kKinds,
             "Where the boxes around people come from: nowhere (plain ORB-SLAM2), a file, a network.\n" +
                 default_text())
      ->group(group);
  app.add_option("--boxes", options.boxes_file,
                 "Boxes recorded before: lines 'timestamp x y width height confidence'")
      ->type_name("FILE")
      ->group(group);
  add_network_options(app, group, options.network);
  app.add_option("--save-boxes", options.save_boxes, "Write what the detector found, for --boxes")
      ->type_name("FILE")
      ->group(group);
}

void add_filter_group(CLI::App& app, DetectorOptions& options) {
  const std::string group = "People: what becomes of them";
  add_choice(app, "--boxes-policy", options.policy, kPolicies,
             "wait: every frame waits for the boxes of its own image; latest: none waits, the newest boxes\n"
             "are carried on. Default wait, with --realtime latest")
      ->group(group);
  app.add_option("--boxes-rate", options.pretend_rate_hz,
                 "With latest: pretend that the detector begins this often, counted in time stamps; default\n"
                 "0: at every frame")
      ->check(CLI::Range(0.0, 1000.0))
      ->type_name("HZ")
      ->group(group);
  app.add_option("--boxes-delay", options.pretend_delay_s,
                 "With latest: pretend that boxes come this much after their image, counted in time stamps")
      ->check(CLI::Range(0.0, 60.0))
      ->type_name("SECONDS")
      ->group(group);
  add_choice(app, "--people-filter", options.filter, kFilters,
             "Which keypoints in the boxes are left out: those on people by their depth, those the paper's\n"
             "Algorithm 1 names, or all. Default sdf")
      ->group(group);
  app.add_flag("--no-reinstate", options.no_reinstate, "Also leave out keypoints on people who do not move")
      ->group(group);
  app.add_option(
         "--draw", options.draw,
         "Write every frame with its boxes, its people, and its keypoints: green, bright when on the\n"
         "map, red when left out")
      ->type_name("DIR")
      ->group(group);
}

void check_kind(const DetectorOptions& options) {
  const DetectorKind kind = *options.kind;
  const std::string detector = std::string("--detector ") + name_of(kind);
  const bool boxes = kind == DetectorKind::kBoxes;
  if (!options.boxes_file.empty() && !boxes) refuse("--boxes", "does not go with " + detector);
  const std::string of_network = first_given(options.network);
  if (kind != DetectorKind::kYolo && !of_network.empty()) refuse(of_network, "does not go with " + detector);
  if (boxes && options.boxes_file.empty()) refuse("--detector boxes", "needs --boxes FILE");
}

void check_without_detector(const DetectorOptions& options) {
  const std::string why = "has nothing to do without a detector: give --boxes or --model";
  if (options.policy) refuse("--boxes-policy", why);
  if (options.filter) refuse("--people-filter", why);
  if (options.no_reinstate) refuse("--no-reinstate", why);
  if (!options.save_boxes.empty()) refuse("--save-boxes", why);
}

}  // namespace

void add_detector_options(CLI::App& app, DetectorOptions& options) {
  add_detector_group(app, options);
  add_filter_group(app, options);
}

void check(DetectorOptions& options, bool realtime) {
  if (!options.kind) {
    if (!options.boxes_file.empty() && !options.network.model.empty())
      refuse("--boxes", "and --model are two detectors; give one");
    const bool network = !options.network.model.empty() || bundled_detector_model();
    options.kind = !options.boxes_file.empty() ? DetectorKind::kBoxes
                   : network                   ? DetectorKind::kYolo
                                               : DetectorKind::kNone;
    options.without_network = options.kind == DetectorKind::kNone;
  }
  check_kind(options);
  const bool latest =
      options.policy.value_or(realtime ? BoxesPolicy::kLatest : BoxesPolicy::kWait) == BoxesPolicy::kLatest;
  const std::string needs_latest = "needs --boxes-policy latest";
  if (options.pretend_rate_hz && !latest) refuse("--boxes-rate", needs_latest);
  if (options.pretend_delay_s && !latest) refuse("--boxes-delay", needs_latest);
  if (options.kind == DetectorKind::kNone) check_without_detector(options);
}

void apply(const DetectorOptions& options, Settings& settings) {
  DetectorSettings& detector = settings.detector;
  detector.kind = options.kind.value_or(detector.kind);
  detector.boxes_file = options.boxes_file;
  if (detector.kind == DetectorKind::kYolo) apply(options.network, detector);
  if (options.policy) detector.policy = options.policy;
  detector.pretend_rate_hz = options.pretend_rate_hz.value_or(detector.pretend_rate_hz);
  detector.pretend_delay_s = options.pretend_delay_s.value_or(detector.pretend_delay_s);
  settings.people.filter = options.filter.value_or(settings.people.filter);
  if (options.no_reinstate) settings.people.reinstate_still = false;
}

}  // namespace cpslam::program
