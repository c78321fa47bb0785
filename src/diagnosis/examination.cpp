#include "diagnosis/examination.h"

#include <algorithm>

#include "diagnosis/alignment.h"
#include "diagnosis/depth_coverage.h"
#include "diagnosis/depth_scale.h"
#include "diagnosis/exposure.h"
#include "diagnosis/intrinsics.h"
#include "diagnosis/sharpness.h"
#include "features/image_check.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr int kSmallestSide = 32;  // px

}  // namespace

Examination::Examination(const std::optional<CameraSettings>& camera) : camera_(camera) {
  checks_.push_back(std::make_unique<DepthScaleCheck>(camera ? std::optional<double>(camera->depth_map_factor)
                                                             : std::nullopt));
  checks_.push_back(std::make_unique<DepthCoverageCheck>());
  checks_.push_back(std::make_unique<AlignmentCheck>());
  checks_.push_back(std::make_unique<ExposureCheck>());
  checks_.push_back(std::make_unique<SharpnessCheck>());
}

void Examination::reject(const std::string& why) {
  if (n_unusable_++ == 0) first_error_ = why;
}

void Examination::add(const RgbdImages& images) {
  ++n_frames_;
  if (!images.error.empty()) {
    reject(images.error);
    return;
  }
  if (std::min(images.colour.cols, images.colour.rows) < kSmallestSide) {
    reject(format_text("the pair at %.6f has %s px: too small to be looked at", images.time_s,
                       size_text(images.colour.size()).c_str()));
    return;
  }
  if (size_.empty()) size_ = images.colour.size();
  if (images.colour.size() != size_) {
    reject(format_text("the pair at %.6f has %s px, those before %s", images.time_s,
                       size_text(images.colour.size()).c_str(), size_text(size_).c_str()));
    return;
  }
  const ExaminedFrame frame = make_examined_frame(images);
  for (const auto& check : checks_) check->add(frame);
}

Finding Examination::readability() const {
  Finding finding{
      Level::kOk,
      "images",
      format_text("%zu pairs looked at, %zu cannot be used", n_frames_, n_unusable_),
      "",
      {{"examined", static_cast<double>(n_frames_)}, {"unusable", static_cast<double>(n_unusable_)}}};
  if (n_unusable_ == 0) return finding;
  finding.level = 20 * n_unusable_ > n_frames_ ? Level::kError : Level::kWarning;
  finding.what += ", the first: " + first_error_;
  finding.advice = "copy or record these pictures again; each costs its frame";
  return finding;
}

Findings Examination::findings() const {
  Findings findings{readability()};
  if (camera_ && !size_.empty()) {
    const Findings more = check_intrinsics(*camera_, size_.width, size_.height);
    findings.insert(findings.end(), more.begin(), more.end());
  }
  for (const auto& check : checks_) {
    const Findings more = check->findings();
    findings.insert(findings.end(), more.begin(), more.end());
  }
  return findings;
}

std::vector<std::size_t> choose_frames(std::size_t n, std::size_t n_wanted) {
  constexpr std::size_t kStretch = 75;
  std::vector<std::size_t> chosen;
  const std::size_t n_chosen = std::min(n, n_wanted);
  const std::size_t n_stretches = std::max<std::size_t>(1, n_chosen / kStretch);
  for (std::size_t i = 0; i < n_chosen; ++i) {
    const std::size_t stretch = i * n_stretches / n_chosen;
    // What is left out is spread between the stretches.
    const std::size_t skipped = n_stretches > 1 ? (n - n_chosen) * stretch / (n_stretches - 1) : 0;
    chosen.push_back(i + skipped);
  }
  return chosen;
}

}  // namespace cpslam::diagnosis
