#include <filesystem>

#include "cpslam/error.h"
#include "cpslam/person_detector.h"
#include "detect/recorded_detector.h"
#include "detect/yolo_detector.h"
#include "io/bundled_file.h"
#include "util/log.h"

namespace cpslam {
namespace {

constexpr const char* kBundledCfg = "models/yc.cfg";
constexpr const char* kBundledWeights = "models/yc.weights";

std::unique_ptr<PersonDetector> make_recorded(const DetectorSettings& settings) {
  if (settings.boxes_file.empty()) {
    throw InputError("the detector 'boxes' needs a file of recorded boxes: give --boxes FILE");
  }
  return std::make_unique<RecordedDetector>(settings.boxes_file);
}

DetectorSettings with_model(DetectorSettings settings) {
  if (!settings.model_cfg.empty() && !settings.model_weights.empty()) return settings;
  const std::string needed = "the detector 'yolo' needs a network: give --model CFG WEIGHTS";
  if (!settings.model_cfg.empty() || !settings.model_weights.empty()) throw InputError(needed);
  const std::optional<DetectorModel> bundled = bundled_detector_model();
  if (!bundled) throw InputError(needed + " (" + no_bundled_detector_model_text() + ")");
  settings.model_cfg = bundled->cfg;
  settings.model_weights = bundled->weights;
  return settings;
}

std::unique_ptr<PersonDetector> make_yolo(const DetectorSettings& settings, const LogSink& log) {
  return make_yolo_detector(with_model(settings), Log(log));
}

}  // namespace

std::optional<DetectorModel> bundled_detector_model() {
  const std::optional<std::string> folder = find_data_folder(data_folders(), {kBundledCfg, kBundledWeights});
  if (!folder) return std::nullopt;
  const std::filesystem::path path = *folder;
  return DetectorModel{(path / kBundledCfg).string(), (path / kBundledWeights).string()};
}

std::string no_bundled_detector_model_text() {
  return not_bundled_text(kBundledWeights);
}

std::unique_ptr<PersonDetector> make_detector(const DetectorSettings& settings, const LogSink& log) {
  try {
    switch (settings.kind) {
      case DetectorKind::kNone:
        return nullptr;
      case DetectorKind::kBoxes:
        return make_recorded(settings);
      case DetectorKind::kYolo:
        return make_yolo(settings, log);
    }
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + "; --detector none does without a detector");
  }
  return nullptr;
}

}  // namespace cpslam
