#include "io/sequence_recorder.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "cpslam/error.h"
#include "io/atomic_file.h"
#include "io/text_table.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;

/// A second of a camera, some 50 MB.
constexpr std::size_t kMaxWaiting = 32;
/// The least that still compresses, for a camera does not wait: 21 ms a frame of 640x480, 23 with the default
/// strategy, whose files are a tenth larger.
constexpr std::array<int, 4> kPng{cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_PNG_STRATEGY,
                                  cv::IMWRITE_PNG_STRATEGY_RLE};

[[noreturn]] void refuse(const std::string& folder, const std::string& why) {
  throw InputError("cannot record into '" + folder + "': " + why);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !(fs::is_directory(folder, error) && fs::is_empty(folder, error)))
    refuse(folder, "it is there and not empty");
  for (const char* const part : {"rgb", "depth"}) {
    fs::create_directories(fs::path(folder) / part, error);
    if (error) refuse(folder, error.message());
  }
}

std::ofstream open_list(const std::string& folder, const std::string& name, const std::string& what) {
  std::ofstream list(folder + "/" + name);
  list << "# " << what << "\n# timestamp filename\n" << std::flush;
  if (!list) refuse(folder, name + " cannot be written");
  return list;
}

}  // namespace

SequenceRecorder::SequenceRecorder(std::string folder, const Settings& settings, WhenBusy when_busy,
                                   LogSink log)
    : folder_(std::move(folder)),
      worker_([this](const RgbdFrame& frame) { write(frame); }, kMaxWaiting, when_busy, std::move(log),
              "the recording ends here") {
  make_folder(folder_);
  colour_list_ = open_list(folder_, "rgb.txt", "colour images");
  depth_list_ = open_list(folder_, "depth.txt", "depth images");
  try {
    write_file_atomically(folder_ + "/settings.yaml", to_yaml(settings));
  } catch (const RunError& error) {
    refuse(folder_, error.what());
  }
  worker_.start();
}

void SequenceRecorder::write(const RgbdFrame& frame) {
  const std::string stamp = stamp_text(frame.time_s);
  const std::string depth_stamp = stamp_text(frame.depth_time_s.value_or(frame.time_s));
  const std::string colour_file = "rgb/" + stamp + ".png";
  const std::string depth_file = "depth/" + depth_stamp + ".png";
  write_picture(colour_file, frame.colour);
  write_picture(depth_file, frame.depth);
  colour_list_ << stamp << ' ' << colour_file << '\n' << std::flush;
  depth_list_ << depth_stamp << ' ' << depth_file << '\n' << std::flush;
  if (!colour_list_ || !depth_list_)
    throw RunError("'" + folder_ + "': its lists cannot be written; is the disk full?");
  ++recorded_;
}

void SequenceRecorder::write_picture(const std::string& file, const cv::Mat& picture) const {
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", picture, png, {kPng.begin(), kPng.end()}))
    throw RunError("'" + folder_ + "/" + file + "': cannot be encoded");
  write_file_atomically(folder_ + "/" + file,
                        std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
}

}  // namespace cpslam
