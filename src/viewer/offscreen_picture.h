#pragma once

#include <opencv2/core/types.hpp>

namespace cpslam::viewer {

/// A picture with depth that is drawn where nobody sees it, to be shown as often as one likes. Lives in the
/// thread of its OpenGL context.
class OffscreenPicture {
 public:
  OffscreenPicture();
  ~OffscreenPicture();
  OffscreenPicture(const OffscreenPicture&) = delete;
  OffscreenPicture& operator=(const OffscreenPicture&) = delete;

  /// From now on is drawn here, on a picture of this size (px) whose pixels hold anything. Throws RunError
  /// when OpenGL refuses such a picture.
  void begin(cv::Size size);
  /// From now on is drawn in the window again.
  void end() const;
  /// Copies it into the window: its lower left corner at this place, px from the window's.
  void show(cv::Point corner) const;

 private:
  void resize(cv::Size size);

  unsigned frame_ = 0;
  unsigned colour_ = 0;
  unsigned depth_ = 0;
  cv::Size size_;
};

}  // namespace cpslam::viewer
