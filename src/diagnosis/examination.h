#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/settings.h"
#include "diagnosis/frame_check.h"
#include "io/image_reader.h"

namespace cpslam::diagnosis {

/// All that is looked at in pictures: depth scale and coverage, exposure, sharpness, time offset,
/// registration, and whether they can be read. Frames in the order of time. One thread.
class Examination {
 public:
  /// camera: the calibration, empty when there is none.
  explicit Examination(const std::optional<CameraSettings>& camera);

  /// A pair that cannot be used (RgbdImages::error) is counted.
  void add(const RgbdImages& images);
  [[nodiscard]] Findings findings() const;
  /// Pairs looked at, those that cannot be used included.
  [[nodiscard]] std::size_t n_frames() const { return n_frames_; }

 private:
  void reject(const std::string& why);
  [[nodiscard]] Finding readability() const;

  const std::optional<CameraSettings> camera_;
  std::vector<std::unique_ptr<FrameCheck>> checks_;
  cv::Size size_;
  std::size_t n_frames_ = 0;
  std::size_t n_unusable_ = 0;
  std::string first_error_;
};

/// Which of n frames to look at when there are too many: stretches of consecutive ones, which motion needs,
/// evenly spread. Ascending.
[[nodiscard]] std::vector<std::size_t> choose_frames(std::size_t n, std::size_t n_wanted);

}  // namespace cpslam::diagnosis
