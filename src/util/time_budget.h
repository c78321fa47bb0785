#pragma once

#include <algorithm>

namespace cpslam {

/// Lets something be done as often as it costs no more than a share of other work: what it cost has to be
/// earned back before it is done again. What is not spent is not saved up. Not thread-safe.
class TimeBudget {
 public:
  /// share: (0, 1]
  explicit TimeBudget(double share) : share_(share) {}

  void earn(double worked_ms) { balance_ms_ = std::min(0.0, balance_ms_ + share_ * worked_ms); }
  void spend(double cost_ms) { balance_ms_ -= cost_ms; }
  [[nodiscard]] bool affordable() const { return balance_ms_ >= 0.0; }

 private:
  double share_;
  double balance_ms_ = 0.0;
};

}  // namespace cpslam
