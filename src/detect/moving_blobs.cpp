#include "detect/moving_blobs.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "detect/person_growth.h"

namespace cpslam {
namespace {

constexpr std::size_t kMinCells = 40;  // 640 px

}  // namespace

std::vector<GridSurface> find_moving_blobs(const cv::Mat1f& depth_m, const cv::Mat1b& still_age,
                                           const cv::Mat1b& people) {
  cv::Mat1b arrived(depth_m.size(), std::uint8_t{0});
  for (int cell = 0; cell < static_cast<int>(depth_m.total()); ++cell) {
    const bool is_new =
        depth_m(cell) > 0.0F && people(cell) == 0 && still_age(cell) < StillSurface::kUnknownAge;
    arrived(cell) = is_new ? 1 : 0;
  }
  cv::Mat1b cores;
  cv::erode(arrived, cores, cv::Mat());
  std::vector<GridSurface> blobs;
  for (int seed = 0; seed < static_cast<int>(cores.total()); ++seed) {
    if (cores(seed) == 0 || arrived(seed) == 0) continue;
    GridSurface blob;
    blob.add(seed, depth_m(seed));
    arrived(seed) = 0;
    for (std::size_t i = 0; i < blob.size(); ++i) {
      const cv::Point at(blob.cells[i] % depth_m.cols, blob.cells[i] / depth_m.cols);
      for (const cv::Point& next :
           {at + cv::Point(1, 0), at - cv::Point(1, 0), at + cv::Point(0, 1), at - cv::Point(0, 1)}) {
        if (!cv::Rect({}, depth_m.size()).contains(next) || arrived(next) == 0) continue;
        if (std::abs(depth_m(next) - depth_m(at)) > connected_step_m(depth_m(at))) continue;
        arrived(next) = 0;
        blob.add(next.y * depth_m.cols + next.x, depth_m(next));
      }
    }
    if (blob.size() >= kMinCells) blobs.push_back(std::move(blob));
  }
  return blobs;
}

}  // namespace cpslam
