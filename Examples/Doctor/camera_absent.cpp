#include "cpslam/error.h"
#include "examine.h"

namespace cpslam::program {

DoctorReport examine_camera(const DoctorOptions&) {
  throw InputError("--camera: built without OpenNI2; install libopenni2-dev and configure again");
}

}  // namespace cpslam::program
