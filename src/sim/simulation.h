#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cpslam/settings.h"
#include "cpslam/types.h"
#include "geometry/se3.h"
#include "io/person_boxes.h"
#include "sim/presets.h"

namespace cpslam::sim {

struct SimulationOptions {
  std::string preset = "office_xyz";
  std::uint64_t seed = 0;                   ///< of room, path, people and noise
  std::optional<std::uint64_t> noise_seed;  ///< other noise on the same room, path and people
  std::optional<int> n_frames;              ///< > 0; the preset's if empty
  std::optional<int> n_people;              ///< 0 to kMaxPeople; the preset's if empty
  double start_s = 0.0;                     ///< time on the path at which the first frame is taken
  bool sensor_noise = false;    ///< structured-light depth and colour noise; else exact depth up to 13.1 m
  bool motion_blur = false;     ///< 20 ms exposure
  bool exposure_drift = false;  ///< brightness wanders by +-25 %
  CameraSettings camera = default_camera();
  int n_threads = 2;  ///< results do not depend on it

  static constexpr int kMaxPeople = 8;
  /// The camera of TUM's freiburg3 without distortion.
  [[nodiscard]] static CameraSettings default_camera();
  /// Throws InputError naming the option that is out of its range.
  void check() const;
};

/// A person seen in a frame.
struct SimulatedPerson {
  int id = 0;
  PersonBox box;               ///< around the visible pixels
  double visible_share = 0.0;  ///< visible pixels by the area of the whole body's box inside the image
};

struct SimulatedFrame {
  double time_s = 0.0;
  cv::Mat colour_bgr;   ///< CV_8UC3
  cv::Mat depth;        ///< CV_16UC1, camera().depth_map_factor units a metre, z; 0: no reading
  cv::Mat person_mask;  ///< CV_8UC1, exact at pixel centres: 0 nobody, else person id + 1
  std::vector<SimulatedPerson> people;  ///< those with at least 2 % of their box visible, by id
  SE3 world_from_camera;                ///< of the optical frame at mid-exposure

  [[nodiscard]] std::vector<PersonBox> boxes() const;
};

/// A place, a camera path and people, rendered frame by frame. render(i) depends on the options and i only.
/// Not thread-safe; several Simulations are independent.
class Simulation {
 public:
  /// Builds everything (some 0.2 s). Throws InputError for a bad option.
  explicit Simulation(const SimulationOptions& options);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  [[nodiscard]] const SimulationOptions& options() const;
  [[nodiscard]] const PresetInfo& preset() const;
  [[nodiscard]] const CameraSettings& camera() const;
  /// ORB-SLAM2's defaults for this camera.
  [[nodiscard]] Settings settings() const;
  [[nodiscard]] int size() const;
  [[nodiscard]] int n_people() const;
  /// index in [0, size()).
  [[nodiscard]] SimulatedFrame render(int index);

  // Truth without rendering.
  [[nodiscard]] double time_s(int index) const;
  [[nodiscard]] SE3 world_from_camera(int index) const;
  [[nodiscard]] Trajectory ground_truth() const;
  /// Joints and ends of a person's limbs (hips, knees, ankles, toes, shoulders, elbows, wrists, finger tips,
  /// head), world.
  [[nodiscard]] std::vector<Eigen::Vector3d> person_joints(int person, int index) const;
  /// Boxes around the rooms and around the furniture on their floors, world.
  [[nodiscard]] const std::vector<Eigen::AlignedBox3f>& rooms() const;
  [[nodiscard]] const std::vector<Eigen::AlignedBox3f>& obstacles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cpslam::sim
