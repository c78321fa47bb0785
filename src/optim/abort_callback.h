#pragma once

#include <atomic>

#include "ceres/iteration_callback.h"

namespace cpslam {

[[nodiscard]] inline bool is_raised(const std::atomic<bool>* flag) {
  return flag != nullptr && flag->load(std::memory_order_relaxed);
}

/// Ends a solve when the flag is raised; Ceres then hands back the last accepted step, the best so far.
class AbortCallback final : public ceres::IterationCallback {
 public:
  explicit AbortCallback(const std::atomic<bool>* abort) : abort_(abort) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return is_raised(abort_) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  const std::atomic<bool>* abort_;
};

}  // namespace cpslam
