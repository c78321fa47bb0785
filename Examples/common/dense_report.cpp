#include "common/dense_report.h"

#include <nlohmann/json.hpp>

#include "common/report_text.h"

namespace cpslam::program {

nlohmann::ordered_json dense_json(const DenseReport& report) {
  return {{"points", report.points},
          {"keyframes", report.keyframes},
          {"dropped_keyframes", report.dropped},
          {"carved_voxels", report.carved_voxels},
          {"seconds", report.seconds}};
}

std::string dense_text(const DenseReport& report) {
  std::string text = line("dense map   %zu points from %zu keyframes, %zu voxels seen through, %.1f s",
                          report.points, report.keyframes, report.carved_voxels, report.seconds);
  if (report.dropped > 0)
    text += line("            without %zu keyframes: more --cloud-memory would hold them", report.dropped);
  return text;
}

}  // namespace cpslam::program
