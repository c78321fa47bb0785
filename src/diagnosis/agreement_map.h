#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace cpslam::diagnosis {

/// Where agreement is best.
struct AgreementPeak {
  cv::Point2d at_px;      ///< finer than a pixel
  double height = 0.0;    ///< above the median of the map
  double contrast = 0.0;  ///< the same in standard deviations of the map
  double at_zero = 0.0;   ///< height without any shift
};

/// How well edges of depth fall on edges of colour, for every shift of depth by whole pixels up to a range.
class AgreementMap {
 public:
  explicit AgreementMap(int range_px);

  /// Adds an edge. colour: strength of the colour's edge at the place moved by (-range, -range), the first of
  /// 2 * range + 1 rows and columns; `stride` floats a row.
  void add_edge(const float* colour, std::size_t stride);
  void add(const AgreementMap& other);
  /// Adds another map, moved by `offset_px`; what it does not cover gets its median, as from chance.
  void add_moved(const AgreementMap& other, cv::Point offset_px);
  void subtract(const AgreementMap& other);

  /// Empty when there is nothing to compare or the best place is at the end of the range.
  [[nodiscard]] std::optional<AgreementPeak> peak() const;
  [[nodiscard]] double highest() const;
  [[nodiscard]] int range_px() const { return range_px_; }
  [[nodiscard]] std::size_t n_edges() const { return n_edges_; }

  /// Takes the median off, so that 0 is what chance gives.
  void centre();

 private:
  [[nodiscard]] double at(int x, int y) const;

  int range_px_;
  int side_;
  std::vector<float> sums_;  // by shift, row by row
  std::size_t n_edges_ = 0;
};

}  // namespace cpslam::diagnosis
