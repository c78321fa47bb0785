// rgbd_tum --viewer in a build without the viewer.
#include <gmock/gmock.h>

#include "programs/office_sequence.h"

namespace cpslam {
namespace {

TEST(ViewerMissing, IsToldInOneLine) {
  const OfficeSequence office;
  expect_refused(office.track({"--viewer"}), {"--viewer", "built without", "libglfw3-dev"});
  expect_refused(office.track({"--viewer-screenshot", "window.png"}), {"built without"});
}

}  // namespace
}  // namespace cpslam
