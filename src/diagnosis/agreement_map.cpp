#include "diagnosis/agreement_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "diagnosis/percentile.h"

namespace cpslam::diagnosis {
namespace {

/// Top of a parabola through three values, from the middle one.
double parabola_top(double before, double here, double after) {
  const double bend = 2.0 * here - before - after;
  return bend > 0.0 ? 0.5 * (after - before) / bend : 0.0;
}

}  // namespace

AgreementMap::AgreementMap(int range_px)
    : range_px_(range_px),
      side_(2 * range_px + 1),
      sums_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

void AgreementMap::add_edge(const float* colour, std::size_t stride) {
  float* sums = sums_.data();
  for (int y = 0; y < side_; ++y, colour += stride, sums += side_) {
    for (int x = 0; x < side_; ++x) sums[x] += colour[x];
  }
  ++n_edges_;
}

void AgreementMap::add(const AgreementMap& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  n_edges_ += other.n_edges_;
}

void AgreementMap::subtract(const AgreementMap& other) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] -= other.sums_[i];
  n_edges_ -= other.n_edges_;
}

void AgreementMap::centre() {
  const auto middle = static_cast<float>(percentile(sums_, 0.5));
  for (float& sum : sums_) sum -= middle;
}

void AgreementMap::add_moved(const AgreementMap& other, cv::Point offset_px) {
  const int x_begin = std::max(0, offset_px.x), x_end = std::min(side_, side_ + offset_px.x);
  const int y_begin = std::max(0, offset_px.y), y_end = std::min(side_, side_ + offset_px.y);
  for (int y = y_begin; y < y_end; ++y) {
    for (int x = x_begin; x < x_end; ++x) {
      sums_[static_cast<std::size_t>(y * side_ + x)] +=
          other.sums_[static_cast<std::size_t>((y - offset_px.y) * side_ + x - offset_px.x)];
    }
  }
  n_edges_ += other.n_edges_;
}

double AgreementMap::at(int x, int y) const {
  return static_cast<double>(sums_[static_cast<std::size_t>((y + range_px_) * side_ + x + range_px_)]);
}

double AgreementMap::highest() const {
  return static_cast<double>(*std::max_element(sums_.begin(), sums_.end()));
}

std::optional<AgreementPeak> AgreementMap::peak() const {
  if (n_edges_ == 0) return std::nullopt;
  const auto index = static_cast<int>(std::max_element(sums_.begin(), sums_.end()) - sums_.begin());
  const int x = index % side_ - range_px_, y = index / side_ - range_px_;
  if (std::max(std::abs(x), std::abs(y)) >= range_px_) return std::nullopt;
  const double middle = percentile(sums_, 0.5);
  const double sigma = std::max(1e-6, (percentile(sums_, 0.75) - percentile(sums_, 0.25)) / 1.349);
  AgreementPeak peak;
  peak.at_px = {x + parabola_top(at(x - 1, y), at(x, y), at(x + 1, y)),
                y + parabola_top(at(x, y - 1), at(x, y), at(x, y + 1))};
  peak.height = at(x, y) - middle;
  peak.contrast = peak.height / sigma;
  peak.at_zero = at(0, 0) - middle;
  return peak;
}

}  // namespace cpslam::diagnosis
