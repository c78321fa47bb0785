// cpslam_doctor --camera on the virtual camera.
#include <gmock/gmock.h>

#include "openni/camera_office.h"

namespace cpslam {
namespace {

using test::CameraOffice;
using testing::HasSubstr;

ProgramResult examine(const CameraOffice& camera, const std::vector<std::string>& device,
                      const std::string& faults = {}) {
  std::vector<std::string> command{
      CPSLAM_DOCTOR_PATH, "--frames", "60",     "--quiet",
      "--resolution",     "320x240",  "--json", camera.folder().file("findings.json"),
      "--camera"};
  command.insert(command.end(), device.begin(), device.end());
  return camera.run_program_on_camera(command, faults);
}

nlohmann::json findings(const CameraOffice& camera) {
  return nlohmann::json::parse(TemporaryFolder::content(camera.folder().file("findings.json")));
}

TEST(CameraDoctor, AHealthyCameraIsFine) {
  const CameraOffice camera;
  const ProgramResult result = examine(camera, {});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("Virtual Camera"));
  EXPECT_THAT(result.out, HasSubstr("DepthMapFactor 1000")) << "as the camera says";
  EXPECT_EQ(count_lines(result.out, "error "), 0U) << result.out;
  EXPECT_EQ(findings(camera).at("source"), "Virtual Camera (virtual://0)");
  EXPECT_GT(findings(camera).at("examined"), 0);
}

TEST(CameraDoctor, AFileIsLookedAtWhole) {
  const CameraOffice camera;
  const std::string file = camera.record_oni(30);
  const ProgramResult result = examine(camera, {file});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_GT(findings(camera).at("examined"), 20);
}

TEST(CameraDoctor, ACameraThatIsUnpluggedIsAnError) {
  const CameraOffice camera;
  const ProgramResult result = examine(camera, {"Virtual"}, "unplug-after=20");
  EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("unplugged"));
}

TEST(CameraDoctor, StampsThatJumpAreAnError) {
  const CameraOffice camera;
  const ProgramResult result = examine(camera, {}, "jump-after=20;jump-us=3000000");
  EXPECT_EQ(result.exit_code, 2) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("longest gap 3."));
}

TEST(CameraDoctor, NoSuchCameraEndsWith1) {
  const CameraOffice camera;
  const ProgramResult result = examine(camera, {"Nobody's"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(lines_of(result.err).size(), 1U) << result.err;
  EXPECT_THAT(result.err, HasSubstr("Nobody's"));
}

}  // namespace
}  // namespace cpslam
