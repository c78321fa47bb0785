#include "detect/calibration_pictures.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <system_error>

#include "cpslam/error.h"
#include "detect/letterbox.h"
#include "io/image_integrity.h"
#include "io/input_file.h"

namespace cpslam {
namespace {

bool is_picture(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

std::vector<std::string> pictures_in(const std::string& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) throw InputError("cannot open the calibration folder '" + folder + "': " + error.message());
  std::vector<std::string> paths;
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (is_picture(entry->path())) paths.push_back(entry->path().string());
  }
  if (error) throw InputError("cannot read the calibration folder '" + folder + "': " + error.message());
  if (paths.empty()) throw InputError("no pictures (.png, .jpg) in the calibration folder '" + folder + "'");
  std::sort(paths.begin(), paths.end());
  return paths;
}

cv::Mat read_picture(const std::string& path) {
  const std::string bytes = read_input_file(path);
  std::string error = image_integrity_error(bytes);
  if (error.empty()) {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    try {
      if (cv::Mat picture = cv::imdecode(encoded, cv::IMREAD_COLOR); !picture.empty()) return picture;
      error = "not a picture";
    } catch (const cv::Exception&) {
      error = "not a picture";
    }
  }
  throw InputError("cannot calibrate on '" + path + "': " + error);
}

}  // namespace

std::vector<cv::Mat> read_calibration_pictures(const std::string& folder, std::size_t count, cv::Size input) {
  const std::vector<std::string> paths = pictures_in(folder);
  const std::size_t n = std::min(count, paths.size());
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < n; ++i) {
    const cv::Mat picture = read_picture(paths[i * paths.size() / n]);
    pictures.push_back(Letterbox(picture.size(), input).fit(picture));
  }
  return pictures;
}

}  // namespace cpslam
