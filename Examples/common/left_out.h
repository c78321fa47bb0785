#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "common/progress_bar.h"

namespace cpslam::program {

/// Counts what could not be used and names the first few, one warning each.
class LeftOut {
 public:
  /// what: "frame", "picture". The bar must outlive this.
  LeftOut(std::string what, ProgressBar& bar) : what_(std::move(what)), bar_(bar) {}
  void add(const std::string& name, const std::string& reason);
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::string what_;
  ProgressBar& bar_;
  std::size_t count_ = 0;
};

}  // namespace cpslam::program
