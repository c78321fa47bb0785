#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "cpslam/settings.h"
#include "io/error_text.h"
#include "io/settings_keys.h"
#include "io/temporary_folder.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kLeast =
    "%YAML:1.0\nCamera.fx: 500.0\nCamera.fy: 501\nCamera.cx: 320.5\nCamera.cy: 240.\n";

class SettingsFile : public testing::Test {
 protected:
  /// The least that loads, and more lines behind it (line 6 and following).
  Settings load(const std::string& more) {
    return load_settings(folder_.write("camera.yaml", kLeast + more));
  }
  std::string error(const std::string& more) {
    return input_error([&] { (void)load(more); });
  }
  TemporaryFolder folder_;
};

TEST_F(SettingsFile, RequiredKeysAndDefaults) {
  const Settings s = load("");
  EXPECT_EQ(s.camera.fx, 500.0);
  EXPECT_EQ(s.camera.fy, 501.0);
  EXPECT_EQ(s.camera.cx, 320.5);
  EXPECT_EQ(s.camera.cy, 240.0);
  EXPECT_EQ(s.camera.depth_map_factor, 5000.0);
  EXPECT_EQ(s.orb.n_features, 1000);
  for (const char* key : {"Camera.fx", "Camera.fy", "Camera.cx", "Camera.cy"}) {
    std::string without = kLeast;
    const std::size_t begin = without.find(key);
    without.erase(begin, without.find('\n', begin) - begin + 1);
    const std::string path = folder_.write("without.yaml", without);
    EXPECT_EQ(input_error([&] { (void)load_settings(path); }), "'" + path + "' lacks the key " + key);
  }
}

TEST_F(SettingsFile, TakesAWholeOrbSlam2File) {
  const Settings s = load(
      "# comment\n\n---\nCamera.k1: -1e-1   # tail\r\nCamera.RGB: 0\nCamera.width: 320\nCamera.height: 240\n"
      "Camera.bf: 47.9\nThDepth: 40\nDepthMapFactor: 5208\nORBextractor.nFeatures: 500.0\n"
      "ORBextractor.iniThFAST: 15\nORBextractor.minThFAST: 5\nViewer.KeyFrameSize: 0.05\nViewer.ViewpointF: "
      "500\n"
      "LEFT.D: !!opencv-matrix\n   rows: 1\n   data:[-0.28, 0.07]\nRIGHT.height: 480\nCamera.fps: 20\n");
  EXPECT_EQ(s.camera.k1, -0.1);
  EXPECT_EQ(s.camera.width, 320);
  EXPECT_EQ(s.camera.bf, 47.9);
  EXPECT_EQ(s.tracking.th_depth, 40.0);
  EXPECT_EQ(s.camera.depth_map_factor, 5208.0);
  EXPECT_EQ(s.orb.n_features, 500);
  EXPECT_EQ(s.orb.ini_th_fast, 15);
  EXPECT_EQ(s.camera.fps, 20.0);
}

TEST_F(SettingsFile, ADepthMapFactorOfZeroMeansMetres) {
  EXPECT_EQ(load("DepthMapFactor: 0\n").camera.depth_map_factor, 1.0);
  EXPECT_EQ(load("DepthMapFactor: -1e-6\n").camera.depth_map_factor, 1.0);
  EXPECT_EQ(load("DepthMapFactor: 1\n").camera.depth_map_factor, 1.0);
  EXPECT_THAT(error("DepthMapFactor: -5000\n"), HasSubstr("outside its range"));
}

TEST_F(SettingsFile, UnknownKeysNameTheNearestKnownOne) {
  const std::string path = folder_.file("camera.yaml");
  EXPECT_EQ(error("Camera.kk1: 0\n"), path + ":6: unknown key 'Camera.kk1'; did you mean Camera.k1?");
  EXPECT_THAT(error("\norbextractor.nfeatures: 0\n"), EndsWith("did you mean ORBextractor.nFeatures?"));
  EXPECT_THAT(error("DepthFactor: 1\n"), EndsWith("did you mean DepthMapFactor?"));
  EXPECT_EQ(error("Zzzzzzzzzzzzzzzzzz: 1\n"), path + ":6: unknown key 'Zzzzzzzzzzzzzzzzzz'");
}

TEST_F(SettingsFile, WrongTypes) {
  const std::string line = folder_.file("camera.yaml") + ":6: ";
  EXPECT_EQ(error("Camera.bf: forty\n"), line + "Camera.bf: 'forty' is not a number");
  EXPECT_EQ(error("Camera.bf: \"40\"\n"), line + "Camera.bf: '\"40\"' is not a number");
  EXPECT_EQ(error("Camera.bf:\n"), line + "Camera.bf: '' is not a number");
  EXPECT_EQ(error("Camera.bf: [40]\n"), line + "Camera.bf: '[40]' is not a number");
  EXPECT_EQ(error("Camera.bf: nan\n"), line + "Camera.bf: 'nan' is not a number");
  EXPECT_EQ(error("ORBextractor.nLevels: 7.5\n"), line + "ORBextractor.nLevels: 7.5 is not a whole number");
}

TEST_F(SettingsFile, OutOfRange) {
  const std::string line = folder_.file("camera.yaml") + ":6: ";
  EXPECT_EQ(error("ORBextractor.nLevels: 0\n"),
            line + "ORBextractor.nLevels: 0 is outside its range, 1 to 16");
  EXPECT_THAT(error("ORBextractor.nFeatures: 99999999999\n"), HasSubstr("outside its range"));
  EXPECT_THAT(error("ORBextractor.scaleFactor: 1.0\n"), HasSubstr("1.01 to 4"));
  EXPECT_THAT(error("ThDepth: 0\n"), HasSubstr("ThDepth: 0 is outside"));
  EXPECT_THAT(error("ORBextractor.iniThFAST: 5\n"),
              AllOf(HasSubstr("camera.yaml"), HasSubstr("minThFAST: 7 is above ORBextractor.iniThFAST, 5")));
}

TEST_F(SettingsFile, BadSyntax) {
  const std::string line = folder_.file("camera.yaml") + ":6: ";
  EXPECT_EQ(error("Camera.fx: 1\n"), line + "key Camera.fx was given before, in line 2");
  EXPECT_EQ(error("nonsense\n"), line + "'nonsense' is not of the form 'key: value'");
  EXPECT_EQ(error("  Camera.k1: 0\n"), line + "'Camera.k1: 0' must not be indented");
  const std::string no_head = folder_.write("a.yaml", "Camera.fx: 1\n");
  EXPECT_THAT(input_error([&] { (void)load_settings(no_head); }),
              AllOf(HasSubstr("a.yaml:1:"), HasSubstr("%YAML")));
}

TEST_F(SettingsFile, UnreadableFiles) {
  const auto loading = [](const std::string& path) {
    return input_error([&] { (void)load_settings(path); });
  };
  EXPECT_THAT(loading(folder_.file("TUMX.yaml")), AllOf(HasSubstr("TUMX.yaml"), HasSubstr("No such file")));
  EXPECT_THAT(loading(folder_.path()), HasSubstr("folder"));
  EXPECT_THAT(loading(folder_.write("e.yaml", "")), HasSubstr("empty"));
}

TEST_F(SettingsFile, EveryKeyGoesThroughYamlAndBack) {
  Settings changed = load("");
  // Another value than the default for every key, so that one that is not written or not read shows.
  for (const SettingsKey& key : settings_keys()) {
    const SettingsMember member = key.member(changed);
    if (double* const* real = std::get_if<double*>(&member)) {
      **real = **real > 1.0 ? **real * 1.1 : 1.0 / 3.0;
    } else {
      *std::get<int*>(member) += 1;
    }
  }
  const std::string yaml = to_yaml(changed);
  Settings read = load_settings(folder_.write("round.yaml", yaml));
  Settings defaults;
  for (const SettingsKey& key : settings_keys()) {
    const auto value = [&](Settings& s) {
      return std::visit([](const auto* v) { return static_cast<double>(*v); }, key.member(s));
    };
    EXPECT_EQ(value(read), value(changed)) << key.name;
    EXPECT_NE(value(read), value(defaults)) << key.name;
  }
  EXPECT_EQ(to_yaml(read), yaml);
}

TEST_F(SettingsFile, CheckNamesTheKey) {
  EXPECT_THAT(input_error([] { Settings().check(); }), HasSubstr("Camera.fx: 0 is outside its range"));
  Settings s = load("");
  EXPECT_NO_THROW(s.check());
  s.mapping.queue_capacity = 0;
  EXPECT_THAT(input_error([&] { s.check(); }), HasSubstr("Mapping.queueCapacity"));
  s = load("");
  s.camera.bf = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(input_error([&] { s.check(); }), HasSubstr("Camera.bf"));
}

TEST(ShippedSettings, LoadWithTheirPublicCalibrations) {
  const std::string folder = std::string(CPSLAM_SOURCE_DIR) + "/Examples/RGB-D/";
  const Settings tum1 = load_settings(folder + "TUM1.yaml");
  EXPECT_EQ(tum1.camera.fx, 517.306408);
  EXPECT_EQ(tum1.camera.k3, 1.163314);
  const Settings tum2 = load_settings(folder + "TUM2.yaml");
  EXPECT_EQ(tum2.camera.fy, 521.007327);
  EXPECT_EQ(tum2.camera.depth_map_factor, 5208.0);
  const Settings tum3 = load_settings(folder + "TUM3.yaml");
  EXPECT_EQ(tum3.camera.fx, 535.4);
  EXPECT_EQ(tum3.camera.k1, 0.0);
  const Settings bonn = load_settings(folder + "Bonn.yaml");
  EXPECT_EQ(bonn.camera.cx, 315.593520);
  for (const Settings& s : {tum1, tum2, tum3, bonn}) {
    EXPECT_EQ(s.camera.width, 640);
    EXPECT_EQ(s.camera.height, 480);
    EXPECT_EQ(s.camera.bf, 40.0);
    EXPECT_EQ(s.camera.fps, 30.0);
    EXPECT_EQ(s.tracking.th_depth, 40.0);
    EXPECT_EQ(s.orb.n_features, 1000);
    EXPECT_EQ(s.orb.scale_factor, 1.2);
    EXPECT_EQ(s.orb.n_levels, 8);
    EXPECT_EQ(s.orb.ini_th_fast, 20);
    EXPECT_EQ(s.orb.min_th_fast, 7);
  }
}

}  // namespace
}  // namespace cpslam
