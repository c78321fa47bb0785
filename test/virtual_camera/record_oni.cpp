// record_oni FILE FRAMES: records the first camera's colour and depth streams with OpenNI2's own recorder.
#include <OpenNI.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

void expect_ok(openni::Status status, const std::string& what) {
  if (status != openni::STATUS_OK) throw std::runtime_error(what + ": " + openni::OpenNI::getExtendedError());
}

void record(const char* file, int n_frames) {
  expect_ok(openni::OpenNI::initialize(), "initialize");
  openni::Device device;
  expect_ok(device.open(openni::ANY_DEVICE), "open");
  openni::VideoStream colour, depth;
  expect_ok(colour.create(device, openni::SENSOR_COLOR), "colour");
  expect_ok(depth.create(device, openni::SENSOR_DEPTH), "depth");
  expect_ok(colour.setMirroringEnabled(false), "mirroring");
  expect_ok(depth.setMirroringEnabled(false), "mirroring");
  openni::Recorder recorder;
  expect_ok(recorder.create(file), "recorder");
  expect_ok(recorder.attach(colour), "attach colour");
  expect_ok(recorder.attach(depth), "attach depth");
  expect_ok(recorder.start(), "start recorder");
  expect_ok(colour.start(), "start colour");
  expect_ok(depth.start(), "start depth");
  openni::VideoFrameRef frame;
  for (int i = 0; i < n_frames; ++i) {
    expect_ok(colour.readFrame(&frame), "read");
    expect_ok(depth.readFrame(&frame), "read");
  }
  recorder.stop();
  recorder.destroy();
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("record_oni FILE FRAMES");
  record(argv[1], std::atoi(argv[2]));
  openni::OpenNI::shutdown();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "record_oni: %s\n", error.what());
  return 1;
}
