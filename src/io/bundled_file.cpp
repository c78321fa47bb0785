#include "io/bundled_file.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace cpslam {
namespace {

namespace fs = std::filesystem;

bool is_file_in(const fs::path& folder, const std::string& file) {
  std::error_code ignored;
  return fs::is_regular_file(folder / file, ignored);
}

}  // namespace

std::vector<std::string> data_folders() {
  std::vector<std::string> folders;
  const auto add = [&folders](const fs::path& folder) {
    const std::string text = folder.lexically_normal().string();
    if (std::find(folders.begin(), folders.end(), text) == folders.end()) folders.push_back(text);
  };
  std::error_code error;
  if (const fs::path executable = fs::read_symlink("/proc/self/exe", error); !error) {
    add(executable.parent_path());
    add(executable.parent_path().parent_path() / CPSLAM_DATA_IN_PREFIX);
  }
  add(CPSLAM_INSTALLED_DATA);
  if (const char* const named = std::getenv("CPSLAM_DATA"); named != nullptr && *named != '\0') add(named);
  return folders;
}

std::optional<std::string> find_data_folder(const std::vector<std::string>& folders,
                                            const std::vector<std::string>& files) {
  const auto found = std::find_if(folders.begin(), folders.end(), [&files](const std::string& folder) {
    return std::all_of(files.begin(), files.end(),
                       [&folder](const std::string& file) { return is_file_in(folder, file); });
  });
  if (found == folders.end()) return std::nullopt;
  return *found;
}

std::optional<std::string> find_bundled_file(const std::string& file) {
  const std::optional<std::string> folder = find_data_folder(data_folders(), {file});
  if (!folder) return std::nullopt;
  return (fs::path(*folder) / file).string();
}

std::string not_bundled_text(const std::string& file) {
  std::string text = "'" + file + "' is ";
  const std::vector<std::string> folders = data_folders();
  for (std::size_t i = 0; i < folders.size(); ++i) {
    text += i == 0 ? "not in '" : i + 1 == folders.size() ? " or '" : ", '";
    text += folders[i] + "'";
  }
  return text;
}

}  // namespace cpslam
