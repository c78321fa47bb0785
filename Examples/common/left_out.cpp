#include "common/left_out.h"

namespace cpslam::program {
namespace {

constexpr std::size_t kMaxWarnings = 10;

}  // namespace

void LeftOut::add(const std::string& name, const std::string& reason) {
  if (++count_ > kMaxWarnings) return;
  bar_.print_line("warning: " + what_ + " " + name + " left out: " + reason);
  if (count_ == kMaxWarnings)
    bar_.print_line("warning: further " + what_ + "s that are left out are only counted");
}

}  // namespace cpslam::program
