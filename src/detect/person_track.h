#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cpslam/types.h"

namespace cpslam {

/// A piece of a surface on a depth grid: cells and, parallel, their depths.
struct GridSurface {
  std::vector<int> cells;
  std::vector<float> depth_m;

  [[nodiscard]] std::size_t size() const { return cells.size(); }
  void clear() {
    cells.clear();
    depth_m.clear();
  }
  void add(int cell, float depth) {
    cells.push_back(cell);
    depth_m.push_back(depth);
  }
};

/// What is known of one person in one frame.
struct PersonTrack {
  std::uint8_t number = 0;  ///< 1 to 254; that of a person gone is used again
  GridSurface visible;      ///< what of him is seen
  GridSurface shape;        ///< what is carried on: visible, or where he must be while something hides him
  Eigen::Vector3f velocity_m_per_s = Eigen::Vector3f::Zero();  ///< against the room, in the camera's axes
  /// Its variance, (m/s)^2 for each axis; people start to walk within a second.
  Eigen::Vector3f velocity_variance = Eigen::Vector3f::Constant(1.0F);
  PersonBox box;             ///< the last detection's, carried along
  double confirmed_s = 0.0;  ///< stamp of the last image in which he was detected
  double seen_s = 0.0;       ///< stamp of the last frame in which his surface was found again
  bool shown = false;        ///< by the boxes of this very frame
  int confirmations = 0;
  int misses = 0;  ///< detections without him since
};

/// What becomes of the velocity's variance in dt_s.
void age_velocity(double dt_s, PersonTrack& track);
/// Takes a measured velocity with its standard deviations into the track, axis by axis (a scalar Kalman
/// filter).
void measure_velocity(const Eigen::Vector3f& measured_m_per_s, const Eigen::Vector3f& sigma_m_per_s,
                      PersonTrack& track);
/// Whether he certainly moves.
[[nodiscard]] bool is_walking(const PersonTrack& track);

/// For how many frames a part of him may look still while he passes by; dt_s: between frames, > 0. The same
/// for all who do not walk.
[[nodiscard]] int passing_frames(const PersonTrack& track, double dt_s);
/// Whether he certainly does not move as a whole.
[[nodiscard]] bool is_resting(const PersonTrack& track);

/// The number of the person at each cell, 0 where there is none.
[[nodiscard]] cv::Mat1b paint_people(const std::vector<PersonTrack>& tracks, cv::Size grid_size);

}  // namespace cpslam
