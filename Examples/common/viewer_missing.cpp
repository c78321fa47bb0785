// In the place of viewer_session.cpp in a build without the viewer.
#include "common/viewer_session.h"
#include "cpslam/error.h"

namespace cpslam::program {

void require_viewer() {
  throw InputError(
      "--viewer: this program was built without the viewer; install libglfw3-dev, libimgui-dev and "
      "libepoxy-dev and build it again");
}

int run_beside_viewer(const SlamOptions&, const ViewedRun&, SlamSession&, RunControl&,
                      const std::function<int()>& work) {
  return work();
}

}  // namespace cpslam::program
