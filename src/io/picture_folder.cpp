#include "io/picture_folder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "cpslam/error.h"

namespace cpslam {
namespace {

bool is_picture(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

}  // namespace

std::vector<std::string> pictures_in(const std::string& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  if (error) throw InputError("cannot open the folder '" + folder + "': " + error.message());
  std::vector<std::string> paths;
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (is_picture(entry->path())) paths.push_back(entry->path().string());
  }
  if (error) throw InputError("cannot read the folder '" + folder + "': " + error.message());
  if (paths.empty()) throw InputError("no pictures (.png, .jpg) in the folder '" + folder + "'");
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace cpslam
