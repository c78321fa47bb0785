#include "diagnosis/intrinsics.h"

#include <gmock/gmock.h>

#include <functional>

#include "diagnosis/findings.h"
#include "support/tum_cameras.h"

namespace cpslam::diagnosis {
namespace {

using testing::HasSubstr;

Finding worst_after(const std::function<void(CameraSettings&)>& change) {
  CameraSettings camera = tum1_camera();
  change(camera);
  return worst_of(check_intrinsics(camera, 640, 480), "intrinsics");
}

TEST(Intrinsics, RealCamerasAreFine) {
  const Findings findings = check_intrinsics(tum1_camera(), 640, 480);
  EXPECT_EQ(worst_level(findings), Level::kOk) << texts_above(findings, Level::kOk);
  EXPECT_NEAR(value_of(findings, "intrinsics", "fov_x_deg"), 63.5, 0.1);
  // At a corner (r = 0.81 from the middle) the radial terms alone move by some 40 px.
  EXPECT_NEAR(value_of(findings, "intrinsics", "corner_distortion_px"), 40.0, 10.0);
}

TEST(Intrinsics, PicturesOfAnotherSize) {
  const Findings findings = check_intrinsics(tum1_camera(), 1280, 960);
  EXPECT_EQ(worst_level(findings), Level::kError);
  EXPECT_THAT(findings.front().what, HasSubstr("1280x960"));
}

TEST(Intrinsics, FocalLengthOfAnotherResolution) {
  const Finding wide = worst_after([](CameraSettings& c) { c.fx = c.fy = 220.0; });
  EXPECT_EQ(wide.level, Level::kWarning) << wide.what;
  const Finding tele = worst_after([](CameraSettings& c) { c.fx = c.fy = 1300.0; });
  EXPECT_EQ(tele.level, Level::kError);
  EXPECT_THAT(tele.what, HasSubstr("field of view"));
}

TEST(Intrinsics, OddPixelsAndPrincipalPoints) {
  EXPECT_THAT(worst_after([](CameraSettings& c) { c.fy *= 1.1; }).what, HasSubstr("fx / fy"));
  EXPECT_EQ(worst_after([](CameraSettings& c) { c.cx = 390.0; }).level, Level::kWarning);
  const Finding crop = worst_after([](CameraSettings& c) { c.cx = 160.0; });
  EXPECT_EQ(crop.level, Level::kError);
  EXPECT_THAT(crop.what, HasSubstr("principal point"));
}

TEST(Intrinsics, DistortionThatFoldsOver) {
  const Finding finding = worst_after([](CameraSettings& c) {
    c.k1 = -1.0;
    c.k2 = c.k3 = 0.0;
  });
  EXPECT_EQ(finding.level, Level::kError);
  EXPECT_THAT(finding.what, HasSubstr("folds"));
}

TEST(Intrinsics, BaselineInAnotherUnit) {
  const Finding finding = worst_after([](CameraSettings& c) { c.bf = 0.08; });
  EXPECT_EQ(finding.level, Level::kWarning);
  EXPECT_THAT(finding.what, HasSubstr("Camera.bf"));
}

}  // namespace
}  // namespace cpslam::diagnosis
