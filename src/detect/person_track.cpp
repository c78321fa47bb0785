#include "detect/person_track.h"

namespace cpslam {

cv::Mat1b paint_people(const std::vector<PersonTrack>& tracks, cv::Size grid_size) {
  cv::Mat1b labels(grid_size, std::uint8_t{0});
  for (const PersonTrack& track : tracks) {
    for (const int cell : track.visible.cells) labels(cell) = track.number;
  }
  return labels;
}

}  // namespace cpslam
