#include "sim/rasterizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/parallel.h"
#include "sim/sample_pattern.h"

namespace cpslam::sim {
namespace {

constexpr double kNear_m = 0.05;
using Triangle = Rasterizer::Triangle;

// Pixel box of the part of the triangle in front of the near plane, in pixels from the principal point.
bool project_bounds(const std::array<const Eigen::Vector3d*, 3>& corners, double fx, double fy,
                    Eigen::AlignedBox2d& box) {
  box.setEmpty();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d& p = *corners[i];
    const Eigen::Vector3d& q = *corners[(i + 1) % 3];
    if (p.z() > kNear_m) box.extend(Eigen::Vector2d(fx * p.x() / p.z(), fy * p.y() / p.z()));
    if ((p.z() > kNear_m) != (q.z() > kNear_m)) {
      const Eigen::Vector3d cut = p + (kNear_m - p.z()) / (q.z() - p.z()) * (q - p);
      box.extend(Eigen::Vector2d(fx * cut.x() / kNear_m, fy * cut.y() / kNear_m));
    }
  }
  return !box.isEmpty();
}

// The pixel columns of one row where all edges of the triangle are positive.
struct Span {
  int begin, end;
};

Span row_span(const Triangle& triangle, float x_offset, float y, int begin, int end) {
  float low = static_cast<float>(begin);
  float high = static_cast<float>(end - 1);
  for (const Eigen::Vector3f& edge : triangle.edges) {
    const float rest = edge.y() * y + edge.z();
    if (edge.x() == 0.0F) {
      if (rest < 0.0F) return {0, 0};
      continue;
    }
    // Neighbours share this quotient to the bit, so no crack opens between them.
    const float crossing = -rest / edge.x() - x_offset;
    if (edge.x() > 0.0F) {
      low = std::max(low, std::ceil(crossing));
    } else {
      high = std::min(high, std::floor(crossing));
    }
  }
  if (!(low <= high)) return {0, 0};
  return {static_cast<int>(low), static_cast<int>(high) + 1};
}

void fill_span(float* __restrict inverse_z, std::uint32_t* __restrict ids, int begin, int end, float slope,
               float start, std::uint32_t id) {
  for (int x = begin; x < end; ++x) {
    const float value = slope * static_cast<float>(x) + start;
    const bool nearer = value > inverse_z[x];
    inverse_z[x] = nearer ? value : inverse_z[x];
    ids[x] = nearer ? id : ids[x];
  }
}

}  // namespace

void SceneObject::update_bounds() {
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh_in_world.vertices) box.extend(vertex.position);
  centre = box.center().cast<double>();
  radius_m = 0.5 * static_cast<double>(box.diagonal().norm());
}

Rasterizer::Rasterizer(const CameraSettings& camera, int n_threads)
    : camera_(camera), n_threads_(std::max(1, n_threads)) {
  const auto& bounds = camera_.undistorted_bounds();
  constexpr int kMargin = 1;  // samples lie up to half a pixel around a pixel's centre
  grid_x_ = static_cast<int>(std::floor(bounds[0])) - (camera_.has_distortion() ? kMargin : 0);
  grid_y_ = static_cast<int>(std::floor(bounds[1])) - (camera_.has_distortion() ? kMargin : 0);
  grid_width_ = static_cast<int>(std::ceil(bounds[2])) + (camera_.has_distortion() ? kMargin : 0) - grid_x_;
  grid_height_ = static_cast<int>(std::ceil(bounds[3])) + (camera_.has_distortion() ? kMargin : 0) - grid_y_;
  if (camera_.has_distortion()) set_up_lookup();
  set_up_bands();
  scratch_.resize(static_cast<std::size_t>(n_threads_));
}

void Rasterizer::set_up_lookup() {
  for (std::size_t k = 0; k < kSamples; ++k) {
    const cv::Point2d offset(kSampleOffsets[k][0], kSampleOffsets[k][1]);
    for (int y = 0; y < camera_.height(); ++y) {
      for (int x = 0; x < camera_.width(); ++x) {
        const Eigen::Vector2d ideal = camera_.undistort({x + offset.x, y + offset.y});
        lookup_[k].ray_px.emplace_back(static_cast<float>(ideal.x() - camera_.cx()),
                                       static_cast<float>(ideal.y() - camera_.cy()));
        const int column = static_cast<int>(std::lround(ideal.x() - offset.x)) - grid_x_;
        const int row = static_cast<int>(std::lround(ideal.y() - offset.y)) - grid_y_;
        lookup_[k].grid_px.emplace_back(std::clamp(column, 0, grid_width_ - 1),
                                        std::clamp(row, 0, grid_height_ - 1));
      }
    }
  }
}

void Rasterizer::set_up_bands() {
  for (int row = 0; row < camera_.height(); row += kBandRows) {
    Band band{row, std::min(row + kBandRows, camera_.height()), 0, 0};
    band.grid_begin = band.row_begin;
    band.grid_end = band.row_end;
    if (camera_.has_distortion()) {
      band.grid_begin = grid_height_;
      band.grid_end = 0;
      for (const Lookup& lookup : lookup_) {
        for (int i = band.row_begin * camera_.width(); i < band.row_end * camera_.width(); ++i) {
          const int grid_row = lookup.grid_px[static_cast<std::size_t>(i)][1];
          band.grid_begin = std::min(band.grid_begin, grid_row);
          band.grid_end = std::max(band.grid_end, grid_row + 1);
        }
      }
    }
    bands_.push_back(band);
  }
  triangles_of_band_.resize(bands_.size());
}

void Rasterizer::set_up_object(const SceneObject& object, const SE3& camera_from_world,
                               std::vector<Triangle>& out, std::vector<Eigen::Vector3d>& points) const {
  const double fx = camera_.fx();
  const double fy = camera_.fy();
  points.clear();
  for (const Vertex& vertex : object.mesh_in_world.vertices)
    points.push_back(camera_from_world * vertex.position.cast<double>());
  for (const Face& face : object.mesh_in_world.faces) {
    const std::array<std::size_t, 3> index{static_cast<std::size_t>(face.a), static_cast<std::size_t>(face.b),
                                           static_cast<std::size_t>(face.c)};
    const Eigen::Vector3d& p0 = points[index[0]];
    const Eigen::Vector3d& p1 = points[index[1]];
    const Eigen::Vector3d& p2 = points[index[2]];
    const std::array<Eigen::Vector3d, 3> normals{p2.cross(p1), p0.cross(p2), p1.cross(p0)};
    const double volume = p0.dot(normals[0]);
    if (volume < 1e-12) continue;  // seen from behind or edge-on
    Eigen::AlignedBox2d box;
    if (!project_bounds({&p0, &p1, &p2}, fx, fy, box)) continue;

    Triangle triangle;
    const double left = static_cast<double>(grid_x_) - camera_.cx();
    const double top = static_cast<double>(grid_y_) - camera_.cy();
    const auto clamp_to = [](double value, int size) {
      return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    triangle.x_begin = clamp_to(std::floor(box.min().x() - left - 0.5), grid_width_);
    triangle.x_end = clamp_to(std::ceil(box.max().x() - left + 0.5) + 1.0, grid_width_);
    triangle.y_begin = clamp_to(std::floor(box.min().y() - top - 0.5), grid_height_);
    triangle.y_end = clamp_to(std::ceil(box.max().y() - top + 0.5) + 1.0, grid_height_);
    if (triangle.x_begin >= triangle.x_end || triangle.y_begin >= triangle.y_end) continue;

    Eigen::Vector3d inverse_z = Eigen::Vector3d::Zero(), s = inverse_z, t = inverse_z, light = inverse_z;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d edge(normals[i].x() / fx, normals[i].y() / fy, normals[i].z());
      triangle.edges[i] = edge.cast<float>();
      const Vertex& vertex = object.mesh_in_world.vertices[index[i]];
      const Eigen::Vector3d weight = edge / volume;
      inverse_z += weight;
      s += static_cast<double>(vertex.uv.x()) * weight;
      t += static_cast<double>(vertex.uv.y()) * weight;
      light += static_cast<double>(vertex.light) * weight;
    }
    triangle.inverse_z = inverse_z.cast<float>();
    triangle.s_over_z = s.cast<float>();
    triangle.t_over_z = t.cast<float>();
    triangle.light_over_z = light.cast<float>();
    triangle.material = face.material;
    triangle.label = object.label;
    out.push_back(triangle);
  }
}

void Rasterizer::set_up_triangles(std::span<const SceneObject* const> objects, const SE3& camera_from_world) {
  std::vector<const SceneObject*> visible;
  const auto& b = camera_.undistorted_bounds();
  const double cx = camera_.cx(), cy = camera_.cy(), fx = camera_.fx(), fy = camera_.fy();
  const std::array<Eigen::Vector3d, 5> planes{
      {{0, 0, 1}, {fx, 0, cx - b[0]}, {-fx, 0, b[2] - cx}, {0, fy, cy - b[1]}, {0, -fy, b[3] - cy}}};
  for (const SceneObject* object : objects) {
    const Eigen::Vector3d centre = camera_from_world * object->centre;
    const bool outside = std::any_of(planes.begin(), planes.end(), [&](const Eigen::Vector3d& plane) {
      return plane.normalized().dot(centre) < -object->radius_m - 0.01;
    });
    if (!outside) visible.push_back(object);
  }
  std::vector<std::vector<Triangle>> parts(visible.size());
  std::vector<std::vector<Eigen::Vector3d>> points(static_cast<std::size_t>(n_threads_));
  for_each_parallel(static_cast<int>(visible.size()), n_threads_, [&](int item, int thread) {
    const auto i = static_cast<std::size_t>(item);
    set_up_object(*visible[i], camera_from_world, parts[i], points[static_cast<std::size_t>(thread)]);
  });
  triangles_.clear();
  for (const std::vector<Triangle>& part : parts)
    triangles_.insert(triangles_.end(), part.begin(), part.end());
  for (std::size_t k = 0; k < bands_.size(); ++k) {
    std::vector<std::uint32_t>& list = triangles_of_band_[k];
    list.clear();
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (triangles_[i].y_end > bands_[k].grid_begin && triangles_[i].y_begin < bands_[k].grid_end)
        list.push_back(static_cast<std::uint32_t>(i));
    }
  }
}

void Rasterizer::draw_band(const Band& band, const std::vector<std::uint32_t>& triangles,
                           Scratch& scratch) const {
  const auto n =
      static_cast<std::size_t>(grid_width_) * static_cast<std::size_t>(band.grid_end - band.grid_begin);
  const auto left = static_cast<float>(grid_x_ - camera_.cx());
  const auto top = static_cast<float>(grid_y_ - camera_.cy());
  for (std::size_t k = 0; k < kSamples; ++k) {
    scratch.inverse_z[k].assign(n, 0.0F);
    scratch.triangle[k].assign(n, 0U);
  }
  for (const std::uint32_t id : triangles) {
    const Triangle& triangle = triangles_[id];
    const int y_begin = std::max(triangle.y_begin, band.grid_begin);
    const int y_end = std::min(triangle.y_end, band.grid_end);
    for (int y = y_begin; y < y_end; ++y) {
      const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y - band.grid_begin) * grid_width_;
      for (std::size_t k = 0; k < kSamples; ++k) {
        const float x_offset = left + kSampleOffsets[k][0];
        const float y_ray = static_cast<float>(y) + top + kSampleOffsets[k][1];
        const Span span = row_span(triangle, x_offset, y_ray, triangle.x_begin, triangle.x_end);
        if (span.begin >= span.end) continue;
        const float slope = triangle.inverse_z.x();
        const float start = slope * x_offset + triangle.inverse_z.y() * y_ray + triangle.inverse_z.z();
        fill_span(scratch.inverse_z[k].data() + row, scratch.triangle[k].data() + row, span.begin, span.end,
                  slope, start, id + 1U);
      }
    }
  }
}

void Rasterizer::render(std::span<const SceneObject* const> objects, const SceneAssets& assets,
                        const SE3& world_from_camera, RenderedView& view) {
  const cv::Size size(camera_.width(), camera_.height());
  view.colour_bgr.create(size, CV_32FC3);
  view.depth_m.create(size, CV_32FC1);
  view.label.create(size, CV_8UC1);
  view.cosine.create(size, CV_32FC1);
  view.depth_return.create(size, CV_8UC1);
  set_up_triangles(objects, world_from_camera.inverse());
  for_each_parallel(static_cast<int>(bands_.size()), n_threads_, [&](int item, int thread) {
    const auto i = static_cast<std::size_t>(item);
    Scratch& scratch = scratch_[static_cast<std::size_t>(thread)];
    draw_band(bands_[i], triangles_of_band_[i], scratch);
    shade_band(bands_[i], assets, scratch, view);
  });
}

}  // namespace cpslam::sim
