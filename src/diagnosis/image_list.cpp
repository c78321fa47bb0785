#include "diagnosis/image_list.h"

#include <filesystem>

#include "cpslam/error.h"
#include "io/text_table.h"
#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr const char* kCheck = "image lists";

void read_rows(TextTable& table, const std::string& sequence_dir, ImageList& list) {
  while (table.next_row()) {
    try {
      table.expect_fields(2, "timestamp filename");
      list.stamps.push_back(table.number(0));
      list.paths.push_back((std::filesystem::path(sequence_dir) / table.text(1)).string());
    } catch (const InputError& error) {
      if (list.n_bad_lines++ == 0) list.first_bad_line = error.what();
    }
  }
}

/// "rgb/1305031453.359684.png"
std::string in_folder(const std::filesystem::path& path) {
  return (path.parent_path().filename() / path.filename()).string();
}

void add_missing_files(const ImageList& list, Findings& findings) {
  std::size_t n_missing = 0;
  std::string first;
  for (const std::string& path : list.paths) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) continue;
    if (n_missing++ == 0) first = in_folder(path);
  }
  if (n_missing == 0) return;
  const bool many = 20 * n_missing > list.paths.size();
  findings.push_back(
      {many ? Level::kError : Level::kWarning,
       kCheck,
       list.name +
           format_text(": %zu of %zu files are not there, the first '", n_missing, list.paths.size()) +
           printable(first) + "'",
       "unpack or copy the sequence again; paths in the list are relative to its folder",
       {{"missing_files", static_cast<double>(n_missing)}}});
}

}  // namespace

ImageList read_image_list(const std::string& sequence_dir, const std::string& name) {
  ImageList list;
  list.name = name;
  try {
    TextTable table((std::filesystem::path(sequence_dir) / name).string());
    read_rows(table, sequence_dir, list);
  } catch (const InputError& error) {
    list.error = error.what();
  }
  return list;
}

Findings check_image_list(const ImageList& list) {
  if (!list.error.empty())
    return {{Level::kError,
             kCheck,
             list.error,
             "a sequence has rgb.txt and depth.txt: a line 'timestamp file' for every picture",
             {}}};
  Findings findings;
  if (list.n_bad_lines > 0)
    findings.push_back(
        {Level::kError,
         kCheck,
         list.name + format_text(": %zu lines cannot be read: ", list.n_bad_lines) + list.first_bad_line,
         "correct the lines: 'timestamp file', the stamp in seconds, comments after '#'",
         {{"bad_lines", static_cast<double>(list.n_bad_lines)}}});
  if (list.stamps.empty()) {
    findings.push_back(
        {Level::kError, kCheck, list.name + " lists no picture", "was the recording ended too early?", {}});
    return findings;
  }
  add_missing_files(list, findings);
  if (findings.empty())
    findings.push_back({Level::kOk,
                        kCheck,
                        list.name + format_text(": %zu pictures, all there", list.stamps.size()),
                        "",
                        {{"pictures", static_cast<double>(list.stamps.size())}}});
  return findings;
}

}  // namespace cpslam::diagnosis
