#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detect/background_planes.h"
#include "detect/place_prior.h"
#include "detect/scene_evidence.h"
#include "detect/sdf_model.h"

namespace cpslam {

/// Cells of the depth grid, ascending, and how much of their outline is no outline: connected in depth to
/// what lies outside the box.
struct GrownSurface {
  std::vector<int> cells;
  /// Those of the cells that are nearer and not connected with the others, ascending: an arm that reaches
  /// out, or somebody else.
  std::vector<int> front;
  float leak = 0.0F;  ///< cells that go on outside, by half the box's perimeter
};

/// Grows the depths of a model into a person's surface on the grid.
class PersonGrowth {
 public:
  /// taken: cells (non-zero) that are somebody else's. Both are referred to, not copied.
  PersonGrowth(const SceneEvidence& scene, const cv::Mat1b& taken);

  /// The connected pieces inside the box that hold inliers of the model: the largest, and others that are not
  /// small beside it and end inside the box (legs below a table), or have just arrived there (an arm, the
  /// rear leg), or, when he moves, are the size of a limb and have not been there for long. Cells are
  /// connected when they lie side by side and have no step in depth, or a small one and both are inliers (an
  /// arm in front of a torso). A gap without readings, the shadow of that arm, is jumped. What lies on the
  /// background planes is not the person's, nor is, when he moves, what stands still. known: what is known of
  /// him.
  [[nodiscard]] GrownSurface grow(const SdfModel& model, const cv::Rect& box_cells, const PlacePrior& prior,
                                  const std::vector<GridPlane>& background, const KnownBox& known);

 private:
  void add_limbs(const cv::Rect& box_cells, int number, bool he_moves, GrownSurface& surface);
  [[nodiscard]] bool is_limb(const std::vector<int>& piece, float depth_m, std::size_t body_cells) const;
  /// What std::sort does, but quicker, as the cells lie close together.
  void put_in_order(std::vector<int>& cells);
  std::vector<int> flood(int seed, int number);
  void visit_neighbour(int from, int dx, int dy, int number, std::vector<int>& cells);
  [[nodiscard]] bool is_free(int x, int y) const;
  [[nodiscard]] float younger_share(const std::vector<int>& cells, std::uint8_t age) const;
  [[nodiscard]] float mean_depth_m(const std::vector<int>& cells) const;
  [[nodiscard]] float arrived_share(const std::vector<int>& cells) const;
  [[nodiscard]] bool moves(const std::vector<int>& piece) const;
  [[nodiscard]] bool was_his(const std::vector<int>& piece) const;
  [[nodiscard]] bool leaks_much(const std::vector<int>& piece) const;
  [[nodiscard]] bool in_band(float depth_m) const;
  [[nodiscard]] int count_leaks(const std::vector<int>& cells) const;
  [[nodiscard]] float weigh(const std::vector<int>& cells, const PlacePrior& prior) const;

  const SceneEvidence& scene_;
  const cv::Mat1f& depth_m_;
  const cv::Mat1b& taken_;
  cv::Mat1i piece_;
  // of the call at hand
  SdfModel model_;
  cv::Rect limits_;
  KnownBox known_;
  float front_m_ = 0.0F;  // nothing nearer is his
  const std::vector<GridPlane>* background_ = nullptr;
};

}  // namespace cpslam
