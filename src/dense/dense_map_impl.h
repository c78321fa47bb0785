#pragma once

#include <memory>
#include <vector>

#include "cpslam/dense_map.h"
#include "dense/dense_views.h"

namespace cpslam {

/// A dense map and what it was made of.
class DenseMap::Impl {
 public:
  /// Brings all views together. Throws InputError for options out of range.
  Impl(const DenseMapOptions& options, std::shared_ptr<const DenseCamera> camera,
       std::vector<PlacedView> views, std::size_t n_dropped_views);

  std::shared_ptr<const DenseCamera> camera;
  std::vector<PlacedView> views;
  std::vector<CloudPoint> points;
  std::size_t n_dropped_views = 0;
  std::size_t n_carved_voxels = 0;
};

}  // namespace cpslam
