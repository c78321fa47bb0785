#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cpslam/types.h"
#include "detect/grid_camera.h"
#include "detect/person_fit.h"
#include "detect/person_track.h"
#include "geometry/se3.h"
#include "util/random.h"

/// Rooms and people of planes, boxes and ellipsoids, rendered exactly into depth grids. The world's axes are
/// those of a camera that looks level: x right, y down, z ahead; the camera stands kCameraHeightM over the
/// floor.
namespace cpslam::scene {

inline constexpr float kCameraHeightM = 1.2F;
/// The depth images' units per metre.
inline constexpr double kUnitsPerM = 5000.0;

/// Depths, and whose they are: 0 the room's, else a person's number.
struct View {
  cv::Mat1f depth_m;
  cv::Mat1b owner;
};

struct Plane {
  Eigen::Vector3f normal;  // unit
  float offset_m = 0.0F;   // normal . point
};

/// Axis-parallel.
struct Block {
  Eigen::Vector3f least, most;
};

struct Ellipsoid {
  Eigen::Vector3f centre, radii;
};

/// Somebody 1.75 m tall, 0.5 m broad, of head, torso and two legs with a gap between.
struct Person {
  std::uint8_t number = 1;
  Eigen::Vector3f feet{0.0F, kCameraHeightM, 2.0F};
  Eigen::Vector3f velocity_m_per_s = Eigen::Vector3f::Zero();
  [[nodiscard]] std::vector<Ellipsoid> limbs(double time_s) const;
};

class DepthScene {
 public:
  DepthScene& wall(float z_m);
  DepthScene& floor();
  DepthScene& plane(const Plane& plane);
  DepthScene& block(const Eigen::Vector3f& least, const Eigen::Vector3f& most);
  DepthScene& person(const Person& person);

  /// On the grid, at the cells' middles.
  [[nodiscard]] View look(const GridCamera& camera, const SE3& world_from_camera = {},
                          double time_s = 0.0) const;
  /// By pixel. The camera must be without distortion.
  [[nodiscard]] View look_close(const PinholeCamera& camera, const SE3& world_from_camera = {},
                                double time_s = 0.0) const;

 private:
  struct Hit;
  [[nodiscard]] Hit cast(const Eigen::Vector3f& from, const Eigen::Vector3f& along,
                         const std::vector<std::pair<Ellipsoid, std::uint8_t>>& limbs) const;
  [[nodiscard]] std::vector<std::pair<Ellipsoid, std::uint8_t>> limbs_at(double time_s) const;

  std::vector<Plane> planes_;
  std::vector<Block> blocks_;
  std::vector<Person> people_;
};

/// 640 x 480, no distortion.
[[nodiscard]] CameraSettings camera_settings();
[[nodiscard]] GridCamera grid_camera();

/// What a depth camera gives: normal noise of structured_light_sigma_m.
void add_noise(View& view, Random& random);
/// CV_16UC1 in kUnitsPerM.
[[nodiscard]] cv::Mat raw_depth(const View& close_view);

/// The cells of a person.
[[nodiscard]] std::vector<int> cells_of(const View& view, std::uint8_t number);
/// The box a detector would draw round the visible part of somebody.
[[nodiscard]] PersonBox box_of(const View& view, std::uint8_t number);
/// Intersection over union of two ascending lists of cells.
[[nodiscard]] double overlap(std::vector<int> a, std::vector<int> b);
/// The track of somebody whose visible surface is known.
[[nodiscard]] PersonTrack track_of(const View& view, std::uint8_t number, double time_s = 0.0);
/// A keypoint in the middle of every `step`-th cell each way.
[[nodiscard]] std::vector<DepthKeypoint> keypoints_on(const View& view, int step = 3);
/// Nothing has stood still, nobody is known.
[[nodiscard]] cv::Mat1b blank(const View& view, std::uint8_t value = 0);

/// A camera at a place in the world, turned about the vertical.
[[nodiscard]] SE3 world_from_camera_at(double x_m, double y_m, double z_m, double yaw_rad = 0.0);

}  // namespace cpslam::scene
