#include "io/input_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
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
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (file.bad()) throw InputError("cannot read '" + path + "': " + std::generic_category().message(errno));
  std::string content = std::move(bytes).str();
  if (content.empty()) throw InputError("'" + path + "' is empty");
  return content;
}

}  // namespace cpslam
