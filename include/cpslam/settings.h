#pragma once

#include <cstdint>
#include <string>

namespace cpslam {

/// Pinhole camera with radial-tangential distortion (the OpenCV and ORB-SLAM2 convention) and registered
/// depth.
struct CameraSettings {
  int width = 640;   ///< px
  int height = 480;  ///< px
  double fx = 0.0;   ///< px, required
  double fy = 0.0;   ///< px, required
  double cx = 0.0;   ///< px, required
  double cy = 0.0;   ///< px, required
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
  double fps = 30.0;  ///< nominal frame rate, Hz
  double bf =
      40.0;  ///< baseline (m) times fx (px) of the depth sensor: turns a depth into a virtual disparity
  double depth_map_factor = 5000.0;  ///< depth image units per metre
};

/// The ORB features of Rublee et al. 2011, extracted as in Mur-Artal et al. 2015.
struct OrbSettings {
  int n_features = 1000;
  double scale_factor = 1.2;
  int n_levels = 8;
  int ini_th_fast = 20;
  int min_th_fast = 7;
};

struct TrackingSettings {
  /// Depths up to th_depth * bf / fx metres are "close": good enough to make a point from a single view.
  double th_depth = 40.0;
  int min_initial_points = 100;  ///< keypoints with depth that the first frame of a map needs
  int min_inliers = 30;          ///< a frame counts as tracked from this many inliers on
};

struct MappingSettings {
  int local_ba_iterations = 10;
  int queue_capacity = 2;  ///< keyframes that may wait; offline, Tracking waits when the queue is full
};

struct Settings {
  CameraSettings camera;
  OrbSettings orb;
  TrackingSettings tracking;
  MappingSettings mapping;
  bool sequential =
      false;               ///< all stages one after the other in the caller's thread: reproducible to the bit
  bool realtime = false;   ///< never wait for the mapper; its load takes part in keyframe decisions
  std::uint64_t seed = 0;  ///< of every random draw

  /// Throws InputError naming the key (as spelled in settings files) that is missing or out of its range.
  void check() const;
};

/// Reads an ORB-SLAM2 settings file (%YAML:1.0). Throws InputError naming file and key when the file cannot
/// be read, a key is unknown, missing, of the wrong type or out of range.
[[nodiscard]] Settings load_settings(const std::string& path);

/// The effective settings in the format load_settings reads.
[[nodiscard]] std::string to_yaml(const Settings& settings);

}  // namespace cpslam
