#include "common/progress_bar.h"

#include <unistd.h>

#include <cstdio>

namespace cpslam::program {
namespace {

constexpr std::size_t kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};

}  // namespace

ProgressBar::ProgressBar(std::string label, std::size_t total, bool enabled)
    : label_(std::move(label)), total_(total), enabled_(enabled), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  finish();
}

void ProgressBar::update(std::size_t done, const std::string& note) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  note_ = note;
  if (!enabled_) return;
  const auto now = std::chrono::steady_clock::now();
  if (terminal_ && (now - drawn_ >= kRedraw || done_ == total_)) {
    drawn_ = now;
    draw();
  } else if (!terminal_ && total_ > 0 && done_ * 10 / total_ > last_tenth_) {
    last_tenth_ = done_ * 10 / total_;
    std::fprintf(stderr, "%s\n", text().c_str());
  }
}

void ProgressBar::print_line(const std::string& line) {
  const std::lock_guard lock(mutex_);
  const bool bar_is_shown = enabled_ && terminal_ && done_ > 0;
  std::fprintf(stderr, "%s%s\n", bar_is_shown ? "\r\033[K" : "", line.c_str());
  if (bar_is_shown) draw();
}

void ProgressBar::finish() {
  const std::lock_guard lock(mutex_);
  if (enabled_ && terminal_ && done_ > 0) {
    draw();
    std::fputc('\n', stderr);
  }
  enabled_ = false;
}

void ProgressBar::draw() {
  std::fprintf(stderr, "\r\033[K%s", text().c_str());
}

std::string ProgressBar::text() const {
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double rate = elapsed_s > 0.0 ? static_cast<double>(done_) / elapsed_s : 0.0;
  const std::string end = note_.empty() ? "" : "  " + note_;
  char numbers[96];
  if (total_ == 0) {
    std::snprintf(numbers, sizeof numbers, " %zu  %.1f/s", done_, rate);
    return label_ + numbers + end;
  }
  const auto eta_s = rate > 0.0 ? static_cast<long>(static_cast<double>(total_ - done_) / rate) : 0L;
  std::string bar(done_ * kBarWidth / total_, '=');
  bar.resize(kBarWidth, ' ');
  std::snprintf(numbers, sizeof numbers, "] %3zu %%  %zu/%zu  %.1f/s  eta %ld:%02ld", done_ * 100 / total_,
                done_, total_, rate, eta_s / 60, eta_s % 60);
  return label_ + " [" + bar + numbers + end;
}

}  // namespace cpslam::program
