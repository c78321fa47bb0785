#include "dense/carving.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <span>

#include "camera/depth_noise.h"

namespace cpslam {
namespace {

constexpr std::uint16_t kNoReading = 65535;

struct Votes {
  int surface = 0;
  int free = 0;
};

/// Voxels that lie together.
struct Block {
  std::size_t begin = 0, end = 0;
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  float radius_m = 0.0F;
};

std::vector<Block> find_blocks(const std::vector<Voxel>& voxels, float side_m) {
  constexpr int kSide = 1 << VoxelGrid::kBlockBits;
  const auto block_of = [](const Voxel& voxel) {
    return Eigen::Vector3i(voxel.cell.unaryExpr([](int c) { return c >> VoxelGrid::kBlockBits; }));
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const Eigen::Vector3i block = block_of(voxels[i]);
    if (i == 0 || block != block_of(voxels[i - 1])) {
      const float block_m = side_m * kSide;
      const Eigen::Vector3f centre = (block.cast<float>().array() + 0.5F) * block_m;
      blocks.push_back({i, i, centre, 0.5F * std::sqrt(3.0F) * block_m});
    }
    blocks.back().end = i + 1;
  }
  return blocks;
}

/// What one view says of voxels.
class Witness {
 public:
  Witness(const DenseCamera& camera, const PlacedView& placed, float side_m)
      : camera_(camera), view_(*placed.view), side_m_(side_m) {
    const SE3 view_from_world = placed.world_from_view.inverse();
    rotation_ = view_from_world.rotation.cast<float>();
    translation_ = view_from_world.translation.cast<float>();
    const cv::Mat around = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::Mat1w without_holes = view_.depth.clone();
    without_holes.setTo(kNoReading, view_.depth == 0);
    cv::erode(without_holes, nearest_, around);
    cv::dilate(view_.depth, farthest_, around);
  }

  [[nodiscard]] bool may_see(const Block& block) const {
    const Eigen::Vector3f centre = rotation_ * block.centre + translation_;
    const float distance_m = centre.norm();
    if (distance_m <= block.radius_m) return true;
    const float angle_rad = std::acos(std::clamp(centre.z() / distance_m, -1.0F, 1.0F));
    return angle_rad <= camera_.cone_rad() + std::asin(block.radius_m / distance_m);
  }

  void vote(const Voxel& voxel, Votes& votes) const {
    const Eigen::Vector3f point = rotation_ * voxel.position_m + translation_;
    const int pixel = camera_.pixel_of(point);
    if (pixel < 0) return;
    const float depth_m = view_.depth_m(pixel);
    if (depth_m <= 0.0F) return;
    const float tolerance_m = tolerance_at(depth_m);
    const cv::Point at(pixel % view_.depth.cols, pixel / view_.depth.cols);
    if (in_m(nearest_(at)) > point.z() + tolerance_m) {
      ++votes.free;
    } else if (in_m(farthest_(at)) >= point.z() - tolerance_m && is_near(at, point.z(), tolerance_m)) {
      ++votes.surface;
    }
  }

 private:
  static float in_m(std::uint16_t depth) { return static_cast<float>(depth) / DenseView::kUnitsPerM; }

  /// Noise of the reading and of the voxel's place, and what poses are off.
  [[nodiscard]] float tolerance_at(float depth_m) const {
    return side_m_ + 0.01F + 0.005F * depth_m + 3.0F * static_cast<float>(structured_light_sigma_m(depth_m));
  }

  [[nodiscard]] bool is_near(const cv::Point& at, float z_m, float tolerance_m) const {
    const cv::Rect around = cv::Rect(at.x - 1, at.y - 1, 3, 3) & cv::Rect({}, view_.depth.size());
    for (int y = around.y; y < around.br().y; ++y) {
      for (int x = around.x; x < around.br().x; ++x) {
        const std::uint16_t d = view_.depth(y, x);
        if (d != 0 && std::abs(in_m(d) - z_m) <= tolerance_m) return true;
      }
    }
    return false;
  }

  const DenseCamera& camera_;
  const DenseView& view_;
  float side_m_;
  Eigen::Matrix3f rotation_;
  Eigen::Vector3f translation_;
  cv::Mat1w nearest_, farthest_;  // around each block
};

bool is_kept(const Votes& votes) {
  return 2 * votes.free < votes.surface;
}

}  // namespace

std::vector<Voxel> carve(std::vector<Voxel> voxels, float side_m, const DenseCamera& camera,
                         const std::vector<PlacedView>& views) {
  const std::vector<Block> blocks = find_blocks(voxels, side_m);
  std::vector<Votes> votes(voxels.size());
  for (const PlacedView& view : views) {
    const Witness witness(camera, view, side_m);
    for (const Block& block : blocks) {
      if (!witness.may_see(block)) continue;
      for (std::size_t i = block.begin; i < block.end; ++i) witness.vote(voxels[i], votes[i]);
    }
  }
  std::size_t n_kept = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (is_kept(votes[i])) voxels[n_kept++] = voxels[i];
  }
  voxels.resize(n_kept);
  return voxels;
}

}  // namespace cpslam
