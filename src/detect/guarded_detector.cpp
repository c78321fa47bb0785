#include "detect/guarded_detector.h"

#include <exception>

namespace cpslam {

GuardedDetector::GuardedDetector(std::unique_ptr<PersonDetector> detector, StageTimer& timer, const Log& log)
    : detector_(std::move(detector)), name_(detector_->name()), timer_(timer), failures_(log) {}

std::optional<std::vector<PersonBox>> GuardedDetector::detect(const cv::Mat& colour, double time_s) {
  try {
    const StageTimer::Scope scope = timer_.time("detect");
    return detector_->detect(colour, time_s);
  } catch (const std::exception& error) {
    report(time_s, error.what());
  } catch (...) {
    report(time_s, "an exception of an unknown type");
  }
  return std::nullopt;
}

void GuardedDetector::report(double time_s, const std::string& failure) {
  failures_.error("the person detector (" + name_ + ") failed on the frame of " + std::to_string(time_s) +
                  ": " + failure + "; tracking goes on without its boxes");
}

}  // namespace cpslam
