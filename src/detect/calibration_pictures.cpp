#include "detect/calibration_pictures.h"

#include <algorithm>

#include "cpslam/error.h"
#include "detect/bgr_picture.h"
#include "detect/letterbox.h"
#include "io/image_reader.h"
#include "io/picture_folder.h"

namespace cpslam {

std::vector<cv::Mat> read_calibration_pictures(const std::string& folder, std::size_t count, cv::Size input) {
  try {
    const std::vector<std::string> paths = pictures_in(folder);
    const std::size_t n = std::min(count, paths.size());
    std::vector<cv::Mat> pictures;
    for (std::size_t i = 0; i < n; ++i) {
      const cv::Mat picture = to_bgr(read_colour_image(paths[i * paths.size() / n]));
      pictures.push_back(Letterbox(picture.size(), input).fit(picture));
    }
    return pictures;
  } catch (const InputError& error) {
    throw InputError(std::string("cannot calibrate the 8-bit network: ") + error.what());
  }
}

}  // namespace cpslam
