#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "diagnosis/agreement_map.h"
#include "diagnosis/delay_search.h"
#include "diagnosis/frame_check.h"
#include "diagnosis/growth_search.h"
#include "diagnosis/image_motion.h"

namespace cpslam::diagnosis {

/// Whether depth lies on colour, in space and in time: edges of depth must meet edges of colour. Depth that
/// is not registered to colour is beside it, by the distance of the two cameras and their different fields of
/// view; depth taken at another time is off by how far the picture has moved since.
class AlignmentCheck : public FrameCheck {
 public:
  void add(const ExaminedFrame& frame) override;
  [[nodiscard]] Findings findings() const override;

 private:
  void keep(FrameAgreement frame);
  [[nodiscard]] Finding registration(const std::optional<DepthDelay>& delay) const;

  ImageMotion motion_;
  GrowthSearch growth_;
  std::optional<AgreementMap> whole_;   // over all frames
  std::vector<FrameAgreement> frames_;  // every n_skip_-th
  double scale_ = 1.0;                  // of the pictures that are compared
  double width_px_ = 0.0;
  std::size_t n_frames_ = 0;
  std::size_t n_skip_ = 1;
};

}  // namespace cpslam::diagnosis
