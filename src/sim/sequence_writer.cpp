#include "sim/sequence_writer.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "cpslam/error.h"
#include "io/person_boxes.h"
#include "io/text_table.h"
#include "io/trajectory_io.h"

namespace cpslam::sim {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw RunError(path.string() + ": cannot be written; is the disk full?");
}

void write_image(const fs::path& path, const cv::Mat& image, const std::vector<int>& parameters) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), image, parameters);
  } catch (const cv::Exception&) {
    written = false;
  }
  if (!written) throw RunError(path.string() + ": cannot be written; is the disk full?");
}

void prepare_directory(const fs::path& directory, const WriteOptions& options) {
  std::error_code error;
  if (fs::exists(directory) && !fs::is_directory(directory))
    throw InputError(directory.string() + ": is not a directory");
  if (!options.force && fs::exists(directory) && !fs::is_empty(directory, error))
    throw InputError(directory.string() + ": is not empty; name another directory or use --force");
  for (const char* name : {"rgb", "depth", "masks"}) {
    if (std::string(name) == "masks" && !options.masks) continue;
    fs::create_directories(directory / name, error);
    if (error) throw RunError((directory / name).string() + ": cannot be made: " + error.message());
  }
}

// One "stamp file" line of rgb.txt and its like.
void add_line(std::string& list, const std::string& name, const std::string& file) {
  list.append(name).append(" ").append(file).append("\n");
}

}  // namespace

void write_sequence(Simulation& simulation, const std::string& directory, const WriteOptions& options) {
  const fs::path root(directory);
  prepare_directory(root, options);
  const std::vector<int> png{cv::IMWRITE_PNG_COMPRESSION, 2};
  const std::vector<int> colour = options.jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, 93} : png;
  const std::string extension = options.jpeg ? ".jpg" : ".png";
  std::string rgb_list = "# color images\n# preset: " + simulation.preset().name + "\n# timestamp filename\n";
  std::string depth_list = "# depth maps\n# preset: " + simulation.preset().name + "\n# timestamp filename\n";
  std::string mask_list = "# person masks: pixel 0 nobody, else person + 1\n# timestamp filename\n";
  std::vector<StampedBoxes> boxes;
  Trajectory truth;
  bool go_on = true;
  for (int i = 0; i < simulation.size() && go_on; ++i) {
    const SimulatedFrame frame = simulation.render(i);
    const std::string name = stamp_text(frame.time_s);
    std::string colour_file = "rgb/" + name;
    colour_file += extension;
    write_image(root / colour_file, frame.colour_bgr, colour);
    write_image(root / "depth" / (name + ".png"), frame.depth, png);
    add_line(rgb_list, name, colour_file);
    add_line(depth_list, name, "depth/" + name + ".png");
    if (options.masks) {
      write_image(root / "masks" / (name + ".png"), frame.person_mask, png);
      add_line(mask_list, name, "masks/" + name + ".png");
    }
    if (!frame.people.empty()) boxes.push_back({frame.time_s, frame.boxes()});
    truth.push_back({frame.time_s, to_pose(frame.world_from_camera)});
    if (options.on_progress) go_on = options.on_progress(i + 1, simulation.size());
  }
  write_text(root / "settings.yaml", to_yaml(simulation.settings()));
  write_trajectory((root / "groundtruth.txt").string(), truth);
  write_person_boxes((root / "person_boxes.txt").string(), boxes);
  if (options.masks) write_text(root / "masks.txt", mask_list);
  write_text(root / "depth.txt", depth_list);
  write_text(root / "rgb.txt", rgb_list);
}

}  // namespace cpslam::sim
