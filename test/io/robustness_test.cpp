// Broken files of every kind must end in a result or in an InputError of one line, never in anything else.
#include <gtest/gtest.h>

#include <functional>

#include "cpslam/settings.h"
#include "io/error_text.h"
#include "io/image_reader.h"
#include "io/person_boxes.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"
#include "io/trajectory_io.h"
#include "io/tum_sequence.h"

namespace cpslam {
namespace {

/// One to eight changes: a byte replaced, a stretch deleted, doubled, or the rest cut off.
std::string mutate(std::string bytes, Random& random) {
  const std::size_t changes = 1 + random.index(8);
  for (std::size_t c = 0; c < changes && !bytes.empty(); ++c) {
    const std::size_t at = random.index(bytes.size());
    const std::size_t length = 1 + random.index(16);
    switch (random.index(5)) {
      case 0:
        bytes.erase(at, length);
        break;
      case 1:
        bytes.insert(at, bytes.substr(at, length));
        break;
      case 2:
        bytes.resize(at);
        break;
      default:
        bytes[at] = static_cast<char>(random.index(256));
    }
  }
  return bytes;
}

std::string random_bytes(Random& random) {
  std::string bytes(random.index(300), '\0');
  for (char& c : bytes) c = static_cast<char>(random.index(256));
  return bytes;
}

/// Feeds mutations of `valid`, and random bytes, to a reader of files.
void torture(const std::string& valid, int rounds, const std::function<void(const std::string& path)>& read) {
  const TemporaryFolder folder;
  Random random(99);
  const auto accepts = [&](const std::string& bytes) {
    const std::string path = folder.write("input", bytes);
    try {
      read(path);
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return false;
    }
  };
  EXPECT_TRUE(accepts(valid));
  int refused = 0;
  for (int i = 0; i < rounds; ++i) refused += accepts(mutate(valid, random)) ? 0 : 1;
  for (int i = 0; i < rounds / 4; ++i) refused += accepts(random_bytes(random)) ? 0 : 1;
  EXPECT_GT(refused, rounds / 4) << "hardly anything was noticed";
}

TEST(Robustness, Settings) {
  Settings settings;
  settings.camera.fx = settings.camera.fy = 500.0;
  torture(to_yaml(settings), 400, [](const std::string& path) { load_settings(path).check(); });
}

TEST(Robustness, Trajectory) {
  torture("# t\n1.5 1 2 3 0 0 0 1\n2.5 1 -2e-3 3 0.5 0.5 0.5 0.5\n", 400,
          [](const std::string& path) { (void)read_trajectory(path); });
}

TEST(Robustness, PersonBoxes) {
  torture("1.5 1 2 3 4 0.5\n1.5 -1 2.5 3 4 0.25\n", 400,
          [](const std::string& path) { (void)read_person_boxes(path); });
}

TEST(Robustness, Associations) {
  torture("1.5 rgb/a.png 1.51 depth/a.png\n1.6 rgb/b.png 1.61 depth/b.png\n", 400,
          [](const std::string& path) { (void)read_associations(".", path); });
}

TEST(Robustness, Images) {
  const TemporaryFolder folder;
  const std::string colour = folder.write("good.png", encode(".png", noise_image({16, 12}, CV_8UC3)));
  const std::string depth = folder.write("good_depth.png", encode(".png", noise_image({16, 12}, CV_16UC1)));
  const auto check = [](const RgbdImages& images) {
    if (!images.error.empty()) throw InputError(images.error);
    EXPECT_EQ(images.colour.size(), images.depth.size());
  };
  for (const char* extension : {".png", ".jpg"}) {
    torture(encode(extension, noise_image({16, 12}, CV_8UC3)), 150, [&](const std::string& path) {
      check(read_rgbd({1.0, 1.0, path, depth}));
    });
  }
  torture(encode(".tiff", noise_image({16, 12}, CV_32FC1)), 150, [&](const std::string& path) {
    check(read_rgbd({1.0, 1.0, colour, path}));
  });
}

}  // namespace
}  // namespace cpslam
