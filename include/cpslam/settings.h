#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
  /// A lost camera that has looked at a place it does not know for so long begins another map there; 0:
  /// never, and never without a vocabulary or loop closing, which could connect the two.
  double new_map_after_s = 3.0;
};

struct MappingSettings {
  int local_ba_iterations = 10;
  int queue_capacity = 2;  ///< keyframes that may wait; offline, Tracking waits when the queue is full
};

enum class DetectorKind {
  kNone,   ///< nothing is filtered: plain ORB-SLAM2 behaviour
  kBoxes,  ///< boxes recorded in a file
  kYolo,   ///< a Darknet YOLO network, run by OpenCV
};

enum class BoxesPolicy {
  kWait,    ///< every frame waits for the boxes of its own image
  kLatest,  ///< no frame waits: the newest boxes are carried into it
};

struct DetectorSettings {
  DetectorKind kind = DetectorKind::kNone;
  std::string boxes_file;     ///< kBoxes: "timestamp x y width height confidence" a line
  std::string model_cfg;      ///< kYolo: Darknet .cfg; both empty: the network that comes with CP-SLAM
  std::string model_weights;  ///< kYolo: Darknet .weights
  int input_width = 0;        ///< of the network, px, a multiple of its largest stride; 0: as its .cfg says
  int input_height = 0;
  double confidence_threshold = 0.6;       ///< of a box around somebody new
  double weak_confidence_threshold = 0.3;  ///< of one that goes on from a box of the last 0.3 s
  double nms_threshold = 0.45;  ///< intersection over union above which the weaker of two boxes goes
  std::vector<int> classes{0};  ///< indices of the classes that count as people
  int n_threads = 0;            ///< > 0: for cv::setNumThreads, which holds for the process; 0: left as it is
  bool quantise = false;        ///< run the network in 8-bit integers: not faster for every network
  std::string calibration;      ///< folder with pictures to calibrate the 8-bit network on, at every start
  double timeout_s = 10.0;      ///< a detection that takes longer is given up, loudly
  std::optional<BoxesPolicy> policy;  ///< empty: kLatest in real time, else kWait
  /// kLatest with --sequential, or to try it out: detections are begun at most this often (0: at every frame)
  /// and arrive this much later, both counted in frame stamps.
  double pretend_rate_hz = 0.0;
  double pretend_delay_s = 0.0;
};

/// What decides which keypoints inside the boxes are on people (docs/method.md).
enum class PeopleFilter {
  kSdf,    ///< MLESAC on depth, grown over the depth image, carried between detections
  kPaper,  ///< the published Algorithm 1 as literally as it can be read
  kBoxes,  ///< every keypoint inside a box
};

struct PeopleSettings {
  PeopleFilter filter = PeopleFilter::kSdf;
  bool reinstate_still = true;  ///< keypoints on people who do not move come back
};

struct LoopSettings {
  bool enabled = true;           ///< needs a vocabulary
  int min_inliers = 40;          ///< points of the earlier visit that a keyframe must see to close a loop
  int consistent_keyframes = 4;  ///< in a row that must recognise the place
};

/// What is kept of the keyframes for a dense map (System::dense_map).
struct DenseSettings {
  bool enabled = false;
  int memory_mb = 512;  ///< at most for that, > 0; a keyframe takes 0.4 MB, and when memory is full some go
};

struct Settings {
  CameraSettings camera;
  OrbSettings orb;
  TrackingSettings tracking;
  MappingSettings mapping;
  DetectorSettings detector;
  PeopleSettings people;
  LoopSettings loops;
  DenseSettings dense;
  std::string vocabulary;  ///< file with the words of images (vocabulary_tool); empty: no place is recognised
  /// Map file to begin with (System::save_map); empty: with nothing. Needs a vocabulary.
  std::string load_map;
  /// Only find the camera in the loaded map, which is not changed. Where the map shows nothing, poses are
  /// carried on from frame to frame. Until System::set_localization() says otherwise.
  bool localization = false;
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
