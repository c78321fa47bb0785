#include "common/class_names.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <system_error>

#include "cpslam/error.h"
#include "io/input_file.h"
#include "io/text_table.h"

namespace cpslam::program {
namespace {

namespace fs = std::filesystem;

constexpr int kMostClasses = 10000;

std::optional<int> as_index(const std::string& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || text.size() > 9 || !std::all_of(text.begin(), text.end(), is_digit))
    return std::nullopt;
  const int index = std::stoi(text);
  return index < kMostClasses ? std::optional(index) : std::nullopt;
}

/// Empty when there is none, or several of other names.
std::string names_file_beside(const fs::path& cfg) {
  std::error_code error;
  const fs::path own = fs::path(cfg).replace_extension(".names");
  if (fs::is_regular_file(own, error)) return own.string();
  const fs::path folder = cfg.has_parent_path() ? cfg.parent_path() : fs::path(".");
  std::vector<std::string> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".names") found.push_back(entry->path().string());
  }
  return found.size() == 1 ? found.front() : std::string();
}

std::vector<std::string> read_names(const std::string& path) {
  std::vector<std::string> names;
  std::istringstream lines(read_input_file(path));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    names.push_back(end == std::string::npos ? std::string() : line.substr(0, end + 1));
  }
  return names;
}

int index_of(const std::string& name, const std::string& cfg) {
  const std::string what = "--classes " + printable(name) + ": ";
  const std::string path = names_file_beside(cfg);
  if (path.empty()) throw InputError(what + "there is no .names file beside '" + cfg + "' to find it in");
  const std::vector<std::string> names = read_names(path);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw InputError(what + "'" + path + "' has no class of this name");
  return static_cast<int>(found - names.begin());
}

}  // namespace

std::vector<int> class_indices(const std::vector<std::string>& classes, const std::string& cfg) {
  std::vector<int> indices;
  for (const std::string& text : classes) {
    const std::optional<int> index = as_index(text);
    indices.push_back(index ? *index : index_of(text, cfg));
  }
  return indices;
}

}  // namespace cpslam::program
