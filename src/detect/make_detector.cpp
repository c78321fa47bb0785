#include "cpslam/error.h"
#include "cpslam/person_detector.h"
#include "detect/recorded_detector.h"
#include "detect/yolo_detector.h"
#include "util/log.h"

namespace cpslam {
namespace {

std::unique_ptr<PersonDetector> make_recorded(const DetectorSettings& settings) {
  if (settings.boxes_file.empty()) {
    throw InputError("the detector 'boxes' needs a file of recorded boxes: give --boxes FILE");
  }
  return std::make_unique<RecordedDetector>(settings.boxes_file);
}

std::unique_ptr<PersonDetector> make_yolo(const DetectorSettings& settings, const LogSink& log) {
  if (settings.model_cfg.empty() || settings.model_weights.empty()) {
    throw InputError("the detector 'yolo' needs a network: give --model CFG WEIGHTS");
  }
  return std::make_unique<YoloDetector>(settings, Log(log));
}

}  // namespace

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
