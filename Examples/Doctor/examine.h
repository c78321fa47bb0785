#pragma once

#include "doctor_options.h"
#include "doctor_report.h"

namespace cpslam::program {

/// Looks at a folder in TUM layout. What is wrong with the data comes back as findings. Throws InputError
/// when there is no such folder, or for a SETTINGS file that cannot be used.
[[nodiscard]] DoctorReport examine_sequence(const DoctorOptions& options);

/// Looks at a camera or an .oni file. Throws InputError when there is no such camera, when it cannot do what
/// is needed, or where CP-SLAM was built without OpenNI2; RunError when it fails.
[[nodiscard]] DoctorReport examine_camera(const DoctorOptions& options);

}  // namespace cpslam::program
