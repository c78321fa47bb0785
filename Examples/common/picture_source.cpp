#include "common/picture_source.h"

#include <filesystem>
#include <sstream>
#include <system_error>

#include "cpslam/error.h"
#include "io/input_file.h"
#include "io/picture_folder.h"
#include "io/text_table.h"
#include "io/tum_sequence.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

std::vector<Picture> pictures_of_sequence(const std::string& folder) {
  std::vector<Picture> pictures;
  for (const StampedImage& image : read_colour_list(folder)) {
    pictures.push_back({stamp_text(image.time_s), image.path, image.time_s});
  }
  return pictures;
}

std::vector<Picture> pictures_of_folder(const std::string& folder) {
  std::vector<Picture> pictures;
  for (const std::string& path : pictures_in(folder)) pictures.push_back({path, path});
  return pictures;
}

/// Names of pictures may hold blanks, so a line is a path as a whole.
std::vector<Picture> pictures_of_list(const std::string& path) {
  std::vector<Picture> pictures;
  std::istringstream lines(read_input_file(path));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    const std::string file = line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
    if (file.find('\0') != std::string::npos) throw InputError("'" + path + "' is not a list of pictures");
    pictures.push_back({file, (fs::path(path).parent_path() / file).string()});
  }
  if (pictures.empty()) throw InputError("'" + path + "' lists no picture");
  return pictures;
}

}  // namespace

std::vector<Picture> find_pictures(const std::string& source) {
  std::error_code ignored;
  if (fs::is_directory(source, ignored)) {
    return fs::exists(fs::path(source) / "rgb.txt", ignored) ? pictures_of_sequence(source)
                                                             : pictures_of_folder(source);
  }
  if (fs::path(source).extension() == ".txt") return pictures_of_list(source);
  if (!fs::exists(source, ignored)) throw InputError("there is no '" + source + "'");
  return {{source, source}};
}

}  // namespace cpslam::program
