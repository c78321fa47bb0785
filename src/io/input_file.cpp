#include "io/input_file.h"

#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "cpslam/error.h"

namespace cpslam {

std::string read_input_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError("'" + path + "' is a folder, not a file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("cannot open '" + path + "': " + std::generic_category().message(errno));
  // One read for a file that has a size; what has none (a pipe) comes piece by piece.
  std::string content;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored) content.resize(size);
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  content.resize(static_cast<std::size_t>(file.gcount()));
  if (file) content.append(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw InputError("cannot read '" + path + "': " + std::generic_category().message(errno));
  if (content.empty()) throw InputError("'" + path + "' is empty");
  return content;
}

std::string read_regular_file(const std::string& path, const std::string& kind) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError("'" + path + "' is no " + kind + ": it is no regular file");
  return read_input_file(path);
}

}  // namespace cpslam
