#include "diagnosis/intrinsics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "util/format_text.h"

namespace cpslam::diagnosis {
namespace {

constexpr const char* kCheck = "intrinsics";

double field_of_view_deg(double size_px, double focal_px) {
  return 2.0 * std::atan(0.5 * size_px / focal_px) * 180.0 / std::numbers::pi;
}

Finding size_error(const CameraSettings& camera, int width, int height) {
  return {Level::kError,
          kCheck,
          format_text("the pictures have %dx%d px, SETTINGS are for %dx%d", width, height, camera.width,
                      camera.height),
          "give the settings of this camera at this resolution; fx, fy, cx, cy scale with the size",
          {}};
}

Finding field_of_view(const CameraSettings& camera) {
  const double fov_deg = field_of_view_deg(camera.width, camera.fx);
  Finding finding{
      Level::kOk,
      kCheck,
      format_text("field of view %.1f x %.1f degrees", fov_deg, field_of_view_deg(camera.height, camera.fy)),
      "",
      {{"fov_x_deg", fov_deg}}};
  if (fov_deg < 30.0 || fov_deg > 120.0) {
    finding.level = Level::kError;
    finding.what += ": RGB-D cameras have 45 to 95 degrees across";
    finding.advice = "fx and fy are of another resolution or in another unit: they are pixels at this size";
  } else if (fov_deg < 42.0 || fov_deg > 100.0) {
    finding.level = Level::kWarning;
    finding.what += ": unusual";
    finding.advice = "check that fx and fy were calibrated at this resolution";
  }
  return finding;
}

void add_pixel_shape(const CameraSettings& camera, Findings& findings) {
  const double ratio = camera.fx / camera.fy;
  if (std::abs(ratio - 1.0) < 0.03) return;
  findings.push_back({Level::kWarning,
                      kCheck,
                      format_text("fx / fy is %.3f: pixels of today's sensors are square", ratio),
                      "calibrate again with more views, and check that the picture was not stretched",
                      {{"fx_by_fy", ratio}}});
}

void add_principal_point(const CameraSettings& camera, Findings& findings) {
  const double x = camera.cx / camera.width - 0.5, y = camera.cy / camera.height - 0.5;
  const double off = std::max(std::abs(x), std::abs(y));
  if (off < 0.08) return;
  findings.push_back(
      {off > 0.2 ? Level::kError : Level::kWarning,
       kCheck,
       format_text("the principal point (%.1f, %.1f) is %.0f %% of the picture away from its middle",
                   camera.cx, camera.cy, 100.0 * off),
       "cx and cy are of another resolution, were swapped, or the picture is a crop",
       {{"principal_point_off_share", off}}});
}

struct Distortion {
  double corner_px = 0.0;   // how far the farthest corner is moved
  bool folds_over = false;  // two directions land on one pixel
};

/// Walks from the middle to the farthest corner of the ideal picture.
Distortion walk_outward(const CameraSettings& camera) {
  constexpr int kSteps = 64;
  const double x_end = std::max(camera.cx, camera.width - camera.cx) / camera.fx;
  const double y_end = std::max(camera.cy, camera.height - camera.cy) / camera.fy;
  const double radius_end = std::hypot(x_end, y_end);
  Distortion result;
  double before = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double r = radius_end * i / kSteps, r2 = r * r;
    const double distorted = r * (1.0 + r2 * (camera.k1 + r2 * (camera.k2 + r2 * camera.k3)));
    if (distorted <= before) result.folds_over = true;
    before = distorted;
  }
  const double tangential = 3.0 * radius_end * radius_end * std::hypot(camera.p1, camera.p2);
  result.corner_px = camera.fx * (std::abs(before - radius_end) + tangential);
  return result;
}

Finding distortion(const CameraSettings& camera) {
  const Distortion found = walk_outward(camera);
  Finding finding{Level::kOk,
                  kCheck,
                  format_text("distortion moves the corners by %.1f px", found.corner_px),
                  "",
                  {{"corner_distortion_px", found.corner_px}}};
  if (found.folds_over) {
    finding.level = Level::kError;
    finding.what = "distortion folds the picture over: beyond some radius it moves inward again";
    finding.advice =
        "the order is k1 k2 p1 p2 k3; calibrate again with the board in the corners, or leave k3 out";
  } else if (found.corner_px > 0.15 * camera.width) {
    finding.level = Level::kWarning;
    finding.what += ": much for an RGB-D camera";
    finding.advice = "the order is k1 k2 p1 p2 k3; fish-eye models have other coefficients";
  }
  return finding;
}

void add_baseline(const CameraSettings& camera, Findings& findings) {
  const double baseline_m = camera.bf / camera.fx;
  if (baseline_m > 0.01 && baseline_m < 0.5) return;
  findings.push_back({Level::kWarning,
                      kCheck,
                      format_text("Camera.bf %g makes a baseline of %.3f m", camera.bf, baseline_m),
                      "Camera.bf is baseline (m) times fx: 40 for Kinect and Xtion at 640x480",
                      {{"baseline_m", baseline_m}}});
}

}  // namespace

Findings check_intrinsics(const CameraSettings& camera, int picture_width, int picture_height) {
  if (camera.width != picture_width || camera.height != picture_height)
    return {size_error(camera, picture_width, picture_height)};
  Findings findings{field_of_view(camera)};
  add_pixel_shape(camera, findings);
  add_principal_point(camera, findings);
  findings.push_back(distortion(camera));
  add_baseline(camera, findings);
  return findings;
}

}  // namespace cpslam::diagnosis
