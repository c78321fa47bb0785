#pragma once

#include <string>
#include <vector>

#include "programs/office_sequence.h"

namespace cpslam::test {

/// The simulated office before a virtual camera: rgbd_openni2 runs on it through the real OpenNI2 library.
class CameraOffice {
 public:
  /// Stamp of the camera's first frame, s.
  static constexpr double kStart_s = 1.0;

  [[nodiscard]] const TemporaryFolder& folder() const { return office_.folder(); }
  [[nodiscard]] const OfficeSequence& office() const { return office_; }
  [[nodiscard]] std::string result(const std::string& name) const { return office_.result(name); }
  [[nodiscard]] nlohmann::json stats() const { return office_.stats(); }
  [[nodiscard]] Trajectory trajectory() const { return office_.trajectory(); }

  /// `program arguments...` with the virtual camera plugged in, and what goes wrong with it,
  /// "unplug-after=20".
  [[nodiscard]] ProgramResult run_program_on_camera(const std::vector<std::string>& command,
                                                    const std::string& faults = {},
                                                    const SignalAt& signal_at = {}) const;
  /// `rgbd_openni2 - <arguments> --output office().output()` without a detector, with the camera's resolution
  /// unless the arguments name one.
  [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments, const std::string& faults = {},
                                  const SignalAt& signal_at = {}) const;
  /// Records so many frames with OpenNI2's own recorder; the file's path.
  [[nodiscard]] std::string record_oni(int n_frames) const;

  /// Where the camera is in the frame with this stamp, as long as no fault has meddled with the stamps.
  [[nodiscard]] Pose true_pose(double time_s) const;

 private:
  const OfficeSequence office_;
};

/// Expects the trajectory's motion to be the camera's to 2 cm and 1 degree.
void expect_true(const Trajectory& trajectory, const CameraOffice& camera);

}  // namespace cpslam::test
