#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "camera/pinhole_camera.h"
#include "geometry/se3.h"
#include "sim/mesh.h"

namespace cpslam::sim {

/// A mesh in the world frame with its bounding sphere.
struct SceneObject {
  Mesh mesh_in_world;
  std::uint8_t label = 0;  ///< 0: static; k + 1: person k
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0.0;

  void update_bounds();
};

/// What the camera sees. Depth and labels belong to the pixel's exact centre, colour to its area.
struct RenderedView {
  cv::Mat colour_bgr;    ///< CV_32FC3, [0, 255] and brighter
  cv::Mat depth_m;       ///< CV_32FC1, z in the camera frame; 0: nothing
  cv::Mat label;         ///< CV_8UC1
  cv::Mat cosine;        ///< CV_32FC1, of the angle between the surface normal and the ray
  cv::Mat depth_return;  ///< CV_8UC1, 0 where the material returns no depth
};

/// Draws triangles on the CPU: homogeneous edge functions (Olano and Greer 1997), so no clipping is needed; a
/// visibility buffer of four samples a pixel, then each visible surface of a pixel is shaded once.
/// Bands of rows are independent: the result does not depend on the number of threads.
class Rasterizer {
 public:
  Rasterizer(const CameraSettings& camera, int n_threads);

  /// Not thread-safe (scratch memory is kept between calls).
  void render(std::span<const SceneObject* const> objects, const SceneAssets& assets,
              const SE3& world_from_camera, RenderedView& view);

  static constexpr int kSamples = 4;
  static constexpr int kBandRows = 16;

  /// A triangle set up for drawing. Linear functions of (x, y, 1), pixels from the principal point.
  struct Triangle {
    std::array<Eigen::Vector3f, 3> edges;  ///< all >= 0 inside
    Eigen::Vector3f inverse_z;             ///< 1 / z
    Eigen::Vector3f s_over_z, t_over_z, light_over_z;
    int x_begin, x_end, y_begin, y_end;  ///< pixels of the visibility grid that may be touched
    int material;
    std::uint8_t label;
  };

 private:
  /// Which sample of the visibility grid each image sample looks at, for one band of image rows.
  struct Band {
    int row_begin = 0, row_end = 0;    ///< image rows
    int grid_begin = 0, grid_end = 0;  ///< rows of the visibility grid that they look at
  };
  struct Scratch {
    std::array<std::vector<float>, kSamples> inverse_z;
    std::array<std::vector<std::uint32_t>, kSamples> triangle;
  };
  /// Image sample to (distortion-free) ray and grid column/row; only filled for cameras with distortion.
  struct Lookup {
    std::vector<cv::Vec2f> ray_px;  ///< pixels from the principal point
    std::vector<cv::Vec2i> grid_px;
  };

  void set_up_lookup();
  void set_up_bands();
  void set_up_triangles(std::span<const SceneObject* const> objects, const SE3& camera_from_world);
  void set_up_object(const SceneObject& object, const SE3& camera_from_world, std::vector<Triangle>& out,
                     std::vector<Eigen::Vector3d>& points) const;
  void draw_band(const Band& band, const std::vector<std::uint32_t>& triangles, Scratch& scratch) const;
  void shade_band(const Band& band, const SceneAssets& assets, const Scratch& scratch,
                  RenderedView& view) const;

  PinholeCamera camera_;
  int n_threads_;
  int grid_x_ = 0, grid_y_ = 0;  ///< first column and row of the visibility grid, image pixels
  int grid_width_ = 0, grid_height_ = 0;
  std::array<Lookup, kSamples> lookup_;
  std::vector<Band> bands_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::uint32_t>> triangles_of_band_;
  std::vector<Scratch> scratch_;
};

}  // namespace cpslam::sim
