#include "io/tum_sequence.h"

#include <filesystem>
#include <utility>

#include "cpslam/error.h"
#include "io/association.h"
#include "io/text_table.h"

namespace cpslam {
namespace {

struct ImageList {
  std::vector<double> stamps;
  std::vector<std::string> paths;
};

std::string path_in(const std::string& sequence_dir, const std::string& file) {
  return (std::filesystem::path(sequence_dir) / file).string();
}

void check_sequence_dir(const std::string& sequence_dir) {
  std::error_code ignored;
  if (std::filesystem::is_directory(sequence_dir, ignored)) return;
  throw InputError("sequence '" + sequence_dir +
                   "' is not a folder: give the one that holds rgb.txt and depth.txt");
}

/// The stamp in a field, which must come after the one before it.
double next_stamp(const TextTable& table, std::size_t field, const std::vector<double>& before) {
  const double stamp = table.number(field);
  if (!before.empty() && stamp <= before.back()) {
    table.fail("timestamp " + table.text(field) +
               " is not later than the one before it: sort the list and remove repeats");
  }
  return stamp;
}

ImageList read_list(const std::string& sequence_dir, const std::string& file) {
  TextTable table(path_in(sequence_dir, file));
  ImageList list;
  while (table.next_row()) {
    table.expect_fields(2, "timestamp filename");
    list.stamps.push_back(next_stamp(table, 0, list.stamps));
    list.paths.push_back(path_in(sequence_dir, table.text(1)));
  }
  if (list.stamps.empty()) table.fail_file("lists no image");
  return list;
}

}  // namespace

std::vector<StampedImage> read_colour_list(const std::string& sequence_dir) {
  check_sequence_dir(sequence_dir);
  ImageList list = read_list(sequence_dir, "rgb.txt");
  std::vector<StampedImage> images;
  for (std::size_t i = 0; i < list.stamps.size(); ++i) {
    images.push_back({list.stamps[i], std::move(list.paths[i])});
  }
  return images;
}

std::vector<RgbdEntry> associate_sequence(const std::string& sequence_dir, double max_difference_s) {
  check_sequence_dir(sequence_dir);
  const ImageList colour = read_list(sequence_dir, "rgb.txt");
  const ImageList depth = read_list(sequence_dir, "depth.txt");
  std::vector<RgbdEntry> entries;
  for (const auto& [i, j] : associate_stamps(colour.stamps, depth.stamps, max_difference_s)) {
    entries.push_back({colour.stamps[i], depth.stamps[j], colour.paths[i], depth.paths[j]});
  }
  if (entries.empty()) {
    throw InputError("sequence '" + sequence_dir + "': no stamp of rgb.txt lies within " +
                     std::to_string(max_difference_s) + " s of one of depth.txt");
  }
  return entries;
}

std::vector<RgbdEntry> read_associations(const std::string& sequence_dir,
                                         const std::string& associations_path) {
  check_sequence_dir(sequence_dir);
  TextTable table(associations_path);
  std::vector<RgbdEntry> entries;
  std::vector<double> stamps;
  while (table.next_row()) {
    table.expect_fields(4, "timestamp colour_file timestamp depth_file");
    stamps.push_back(next_stamp(table, 0, stamps));
    entries.push_back({stamps.back(), table.number(2), path_in(sequence_dir, table.text(1)),
                       path_in(sequence_dir, table.text(3))});
  }
  if (entries.empty()) table.fail_file("lists no pair of images");
  return entries;
}

}  // namespace cpslam
