#include "common/output_folder.h"

#include <unistd.h>

#include <fstream>

#include "cpslam/error.h"

namespace cpslam::program {

namespace fs = std::filesystem;

void prepare_output_folder(const std::string& option, const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path probe = fs::path(folder) / ".cpslam_probe";
  const bool writable = !error && fs::is_directory(folder) && std::ofstream(probe).put('\n').good();
  fs::remove(probe, error);
  if (!writable) throw InputError(option + " " + folder + ": cannot write there");
}

std::vector<fs::path> find_files(const std::string& folder, const std::regex& name) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (std::regex_match(entry.path().filename().string(), name)) found.push_back(entry.path());
  }
  return found;
}

void check_writable(const std::string& option, const std::string& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder)) throw InputError(option + " " + file + ": there is no such folder");
  if (fs::is_directory(file)) throw InputError(option + " " + file + ": is a folder, not a file");
  // What is no file, such as a pipe, is written to directly; a file is made beside the old one first.
  const bool in_place = fs::exists(file) && !fs::is_regular_file(file);
  if (::access(in_place ? file.c_str() : folder.c_str(), W_OK) != 0)
    throw InputError(option + " " + file + ": cannot write there");
}

}  // namespace cpslam::program
