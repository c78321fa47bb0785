#include <algorithm>
#include <cmath>

#include "sim/rasterizer.h"
#include "sim/sample_pattern.h"

namespace cpslam::sim {
namespace {

using Triangle = Rasterizer::Triangle;

struct RayPx {
  float x, y;  // from the principal point
};

float evaluate(const Eigen::Vector3f& plane, RayPx ray) {
  return plane.x() * ray.x + plane.y() * ray.y + plane.z();
}

Eigen::Array3f shade(const Triangle& triangle, const SceneAssets& assets, RayPx ray) {
  const float inverse_z = evaluate(triangle.inverse_z, ray);
  if (!(inverse_z > 0.0F))
    return Eigen::Array3f::Zero();  // a ray of a distorting lens just beyond the surface
  const float z = 1.0F / inverse_z;
  TextureFootprint f;
  f.s = evaluate(triangle.s_over_z, ray) * z;
  f.t = evaluate(triangle.t_over_z, ray) * z;
  f.ds_dx = (triangle.s_over_z.x() - f.s * triangle.inverse_z.x()) * z;
  f.dt_dx = (triangle.t_over_z.x() - f.t * triangle.inverse_z.x()) * z;
  f.ds_dy = (triangle.s_over_z.y() - f.s * triangle.inverse_z.y()) * z;
  f.dt_dy = (triangle.t_over_z.y() - f.t * triangle.inverse_z.y()) * z;
  const Material& material = assets.materials[static_cast<std::size_t>(triangle.material)];
  const float light = evaluate(triangle.light_over_z, ray) * z;
  return assets.textures[static_cast<std::size_t>(material.texture)].sample(f) * material.tint_bgr * light;
}

// Cosine between the triangle's normal and the ray; the plane of 1/z is the normal up to scale.
float incidence(const Triangle& triangle, RayPx ray, float inverse_z, float fx, float fy) {
  const Eigen::Vector3f normal(triangle.inverse_z.x() * fx, triangle.inverse_z.y() * fy,
                               triangle.inverse_z.z());
  const Eigen::Vector3f direction(ray.x / fx, ray.y / fy, 1.0F);
  return inverse_z / (normal.norm() * direction.norm());
}

}  // namespace

void Rasterizer::shade_band(const Band& band, const SceneAssets& assets, const Scratch& scratch,
                            RenderedView& view) const {
  const auto fx = static_cast<float>(camera_.fx());
  const auto fy = static_cast<float>(camera_.fy());
  const auto cx = static_cast<float>(camera_.cx());
  const auto cy = static_cast<float>(camera_.cy());
  const bool distorted = camera_.has_distortion();
  const int width = camera_.width();
  std::array<std::uint32_t, kSamples> ids{};
  std::array<RayPx, kSamples> rays{};
  for (int y = band.row_begin; y < band.row_end; ++y) {
    auto* colour = view.colour_bgr.ptr<cv::Vec3f>(y);
    auto* depth = view.depth_m.ptr<float>(y);
    auto* label = view.label.ptr<std::uint8_t>(y);
    auto* cosine = view.cosine.ptr<float>(y);
    auto* depth_return = view.depth_return.ptr<std::uint8_t>(y);
    for (int x = 0; x < width; ++x) {
      for (std::size_t k = 0; k < kSamples; ++k) {
        int column = x;
        int row = y;
        rays[k] = {static_cast<float>(x) - cx + kSampleOffsets[k][0],
                   static_cast<float>(y) - cy + kSampleOffsets[k][1]};
        if (distorted) {
          const auto i =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
          column = lookup_[k].grid_px[i][0];
          row = lookup_[k].grid_px[i][1];
          rays[k] = {lookup_[k].ray_px[i][0], lookup_[k].ray_px[i][1]};
        }
        ids[k] = scratch.triangle[k][static_cast<std::size_t>(row - band.grid_begin) *
                                         static_cast<std::size_t>(grid_width_) +
                                     static_cast<std::size_t>(column)];
      }
      Eigen::Array3f sum = Eigen::Array3f::Zero();
      for (std::size_t k = 0; k < kSamples; ++k) {
        // Samples on one surface share one look-up at their mean.
        if (std::find(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(k), ids[k]) !=
            ids.begin() + static_cast<std::ptrdiff_t>(k))
          continue;
        if (ids[k] == 0U) continue;
        float n = 0.0F;
        RayPx mean{0.0F, 0.0F};
        for (std::size_t j = k; j < kSamples; ++j) {
          if (ids[j] != ids[k]) continue;
          mean = {mean.x + rays[j].x, mean.y + rays[j].y};
          n += 1.0F;
        }
        sum += n * shade(triangles_[ids[k] - 1U], assets, {mean.x / n, mean.y / n});
      }
      sum /= static_cast<float>(kSamples);
      colour[x] = {sum[0], sum[1], sum[2]};
      depth[x] = cosine[x] = 0.0F;
      label[x] = depth_return[x] = 0;
      if (ids[0] == 0U) continue;
      const Triangle& centre = triangles_[ids[0] - 1U];
      const float inverse_z = evaluate(centre.inverse_z, rays[0]);
      if (!(inverse_z > 0.0F)) continue;
      depth[x] = 1.0F / inverse_z;
      label[x] = centre.label;
      cosine[x] = incidence(centre, rays[0], inverse_z, fx, fy);
      depth_return[x] = assets.materials[static_cast<std::size_t>(centre.material)].returns_depth ? 1 : 0;
    }
  }
}

}  // namespace cpslam::sim
