#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cpslam/types.h"
#include "io/temporary_folder.h"
#include "programs/program_run.h"

namespace cpslam {

/// A few small frames of the simulated office in a folder of the test's own, for rgbd_tum to run on.
class OfficeSequence {
 public:
  static constexpr std::size_t kFrames = 12;
  static constexpr int kWidth = 320, kHeight = 240;

  /// preset: of the simulator; with people in it there is a person_boxes.txt too. start_s: into its path.
  explicit OfficeSequence(const std::string& preset = "office_xyz", double start_s = 0.0);

  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }
  [[nodiscard]] std::string path() const { return folder_.file("office"); }
  [[nodiscard]] std::string file(const std::string& name) const { return path() + "/" + name; }
  [[nodiscard]] std::string settings() const { return file("settings.yaml"); }
  [[nodiscard]] std::string output() const { return folder_.file("results"); }
  [[nodiscard]] std::string result(const std::string& name) const { return output() + "/" + name; }
  /// Files of a frame, relative to path().
  [[nodiscard]] const std::string& colour(std::size_t frame) const { return colour_[frame]; }
  [[nodiscard]] const std::string& depth(std::size_t frame) const { return depth_[frame]; }
  [[nodiscard]] double time_s(std::size_t frame) const { return times_s_[frame]; }

  /// Writes an associations file that shows these pairs of files, 1/30 s apart, and returns its path.
  [[nodiscard]] std::string associations(const std::vector<std::pair<std::string, std::string>>& pairs) const;
  /// The sequence's pairs, forward or backward.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> pairs(bool backward = false) const;

  /// Gives a key of the settings file another value.
  void change_setting(const std::string& key, const std::string& value) const;

  /// `rgbd_tum - SETTINGS SEQUENCE <arguments> --output output()`, without a detector when the arguments name
  /// none: whether there is a bundled network makes no difference.
  [[nodiscard]] ProgramResult track(const std::vector<std::string>& arguments = {},
                                    const SignalAt& signal_at = {}) const;
  [[nodiscard]] nlohmann::json stats() const;
  [[nodiscard]] Trajectory trajectory() const;

 private:
  TemporaryFolder folder_;
  std::vector<std::string> colour_, depth_;
  std::vector<double> times_s_;
};

}  // namespace cpslam
