#include "detect/person_mask.h"

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "detect/depth_grid.h"

namespace cpslam {
namespace {

/// Nearest and farthest depth of a person around a cell.
struct Band {
  std::uint8_t number = 0;
  float nearest_m = 0.0F;
  float farthest_m = 0.0F;
};

Band band_around(const cv::Mat1b& labels, const cv::Mat1f& depth_m, int x, int y) {
  Band band;
  const cv::Rect around = cv::Rect(x - 1, y - 1, 3, 3) & cv::Rect({}, labels.size());
  band.number = labels(y, x);
  for (int v = around.y; v < around.br().y; ++v) {
    for (int u = around.x; u < around.br().x; ++u) {
      const std::uint8_t number = labels(v, u);
      if (number == 0 || (band.number != 0 && number != band.number)) continue;
      const float d = depth_m(v, u);
      band.nearest_m = band.number == 0 || band.nearest_m == 0.0F ? d : std::min(band.nearest_m, d);
      band.farthest_m = std::max(band.farthest_m, d);
      band.number = number;
    }
  }
  return band;
}

template <typename Unit>
void paint_cell(const Band& band, bool own_cell, const cv::Mat& depth, float metres_per_unit,
                const cv::Rect& pixels, cv::Mat1b& mask) {
  const float tolerance_m = 0.03F + 0.02F * band.farthest_m;
  for (int y = pixels.y; y < pixels.br().y; ++y) {
    const Unit* row = depth.ptr<Unit>(y);
    for (int x = pixels.x; x < pixels.br().x; ++x) {
      const float d = static_cast<float>(row[x]) * metres_per_unit;
      const bool read = d > 0.0F && std::isfinite(d);
      const bool his =
          read ? d > band.nearest_m - tolerance_m && d < band.farthest_m + tolerance_m : own_cell;
      if (his) mask(y, x) = band.number;
    }
  }
}

}  // namespace

cv::Mat1b person_mask(const GridCamera& camera, const std::vector<PersonTrack>& tracks, const cv::Mat& depth,
                      double metres_per_unit) {
  cv::Mat1b mask(camera.image_size(), std::uint8_t{0});
  if (tracks.empty()) return mask;
  const cv::Mat1b labels = paint_people(tracks, camera.size());
  cv::Mat1f depth_m(camera.size(), 0.0F);
  for (const PersonTrack& track : tracks) {
    for (std::size_t i = 0; i < track.visible.size(); ++i)
      depth_m(track.visible.cells[i]) = track.visible.depth_m[i];
  }
  cv::Mat1b near_somebody;
  cv::dilate(labels, near_somebody, {});
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (near_somebody(y, x) == 0) continue;
      const Band band = band_around(labels, depth_m, x, y);
      const cv::Rect pixels(x * kDepthCellPx, y * kDepthCellPx, kDepthCellPx, kDepthCellPx);
      const bool own_cell = labels(y, x) != 0;
      if (depth.type() == CV_32FC1) {
        paint_cell<float>(band, own_cell, depth, static_cast<float>(metres_per_unit), pixels, mask);
      } else {
        paint_cell<std::uint16_t>(band, own_cell, depth, static_cast<float>(metres_per_unit), pixels, mask);
      }
    }
  }
  return mask;
}

}  // namespace cpslam
