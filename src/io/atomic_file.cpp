#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "cpslam/error.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;

/// 0, or the errno of what failed. A disk may turn out to be full only at the last flush, so fclose counts.
int write_file(const std::string& path, std::string_view content, Durability durability) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  if (durability == Durability::kOnDisk) {
    written = written && std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  }
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) return write_error;
  return closed ? 0 : errno;
}

/// A renamed file is where it belongs after a power failure only when its folder is on the disk as well. Not
/// every file system can say so, and the file itself is safe.
void flush_folder(const fs::path& folder) {
  const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

[[noreturn]] void fail(const std::string& path, const std::string& cause) {
  throw RunError("cannot write '" + path + "': " + cause);
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view content, Durability durability) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto message = [](int code) { return std::generic_category().message(code); };
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (const int code = write_file(path, content, Durability::kWritten); code != 0)
      fail(path, message(code));
    return;
  }
  const fs::path target = fs::is_regular_file(status) ? fs::canonical(path, error) : fs::path(path);
  const fs::path partial = target.string() + ".partial";
  if (const int code = write_file(partial.string(), content, durability); code != 0) {
    fs::remove(partial, error);
    fail(path, message(code));
  }
  fs::rename(partial, target, error);
  if (!error) {
    if (durability == Durability::kOnDisk) flush_folder(target.parent_path());
    return;
  }
  const std::string cause = error.message();
  fs::remove(partial, error);
  fail(path, cause);
}

}  // namespace cpslam
