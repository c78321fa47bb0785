// Broken model files of every kind must end in a detector or in an InputError of one line, never in anything
// else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cpslam/person_detector.h"
#include "detect/darknet_network.h"
#include "detect/generated_network.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"

namespace cpslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

GeneratedNetwork small_network() {
  GeneratedNetwork network;
  network.input = {32, 64};
  network.n_classes = 3;
  network.anchors = {{{8.0, 24.0}}, {{20.0, 20.0}, {9.0, 40.0}}};
  return network;
}

class BrokenModelTest : public testing::Test {
 protected:
  BrokenModelTest() {
    settings_.kind = DetectorKind::kYolo;
    settings_.model_cfg = folder_.write("net.cfg", config_);
    settings_.model_weights = folder_.write("net.weights", weights_);
  }

  /// Whether these files make a detector that survives a picture.
  bool works(const std::string& config, const std::string& weights) {
    folder_.write("net.cfg", config);
    folder_.write("net.weights", weights);
    std::unique_ptr<PersonDetector> detector;
    try {
      detector = make_detector(settings_);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      EXPECT_THAT(error.what(), HasSubstr("--detector none"));
      return false;
    }
    (void)detector->detect(noise_image({60, 40}, CV_8UC3), 0.0);
    return true;
  }

  static std::string mutate(std::string bytes, Random& random, bool keep_size) {
    for (std::size_t changes = 1 + random.index(4); changes > 0 && !bytes.empty(); --changes) {
      const std::size_t at = random.index(bytes.size());
      const std::size_t kind = keep_size ? 3 : random.index(6);
      if (kind == 0) {
        bytes.erase(at, 1 + random.index(16));
      } else if (kind == 1) {
        bytes.insert(at, bytes.substr(at, 1 + random.index(16)));
      } else if (kind == 2) {
        bytes.resize(at);
      } else if (kind == 3) {
        bytes[at] = static_cast<char>(random.index(256));
      } else {
        bytes[at] = static_cast<char>('0' + static_cast<char>(random.index(10)));
      }
    }
    return bytes;
  }

  TemporaryFolder folder_;
  DetectorSettings settings_;
  std::string config_ = small_network().config();
  std::string weights_ = weights_file(small_network().weights());
};

TEST_F(BrokenModelTest, TheWholeOneWorks) {
  EXPECT_TRUE(works(config_, weights_));
}

TEST_F(BrokenModelTest, ConfigsCutOffAnywhere) {
  // The last value may lose digits and still be one.
  for (std::size_t size = 0; size + 20 < config_.size(); ++size) {
    EXPECT_FALSE(works(config_.substr(0, size), weights_)) << size;
  }
}

TEST_F(BrokenModelTest, ChangedConfigs) {
  Random random(11);
  int good = 0;
  for (int i = 0; i < 600; ++i) good += works(mutate(config_, random, false), weights_) ? 1 : 0;
  EXPECT_GT(good, 0);
  EXPECT_LT(good, 400);
}

TEST_F(BrokenModelTest, ChangedConfigsWhoseWeightsFit) {
  // Past our checks, so that OpenCV gets to see what they let through.
  const std::string config =
      "[net]\nwidth=64\nheight=32\nchannels=3\n"
      "[convolutional]\nbatch_normalize=1\nfilters=8\nsize=3\nstride=2\npad=1\nactivation=swish\n"
      "[convolutional]\ngroups=4\nfilters=8\nsize=5\nstride=1\npad=1\nactivation=leaky\n"
      "[shortcut]\nfrom=-2\nactivation=linear\n[dropout]\nprobability=.2\n"
      "[route]\nlayers=-1\ngroups=2\ngroup_id=1\n[maxpool]\nsize=2\nstride=2\n"
      "[convolutional]\nfilters=16\nsize=1\nstride=1\npadding=0\nactivation=mish\n[upsample]\nstride=2\n"
      "[route]\nlayers=-1,-4,1\n[convolutional]\nfilters=14\nsize=1\nactivation=linear\n"
      "[yolo]\nmask=0,2\nanchors=3,4, 5,6, 20,30\nclasses=2\nnum=3\nscale_x_y=1.1\n";
  Random random(14);
  int good = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string changed = i == 0 ? config : mutate(config, random, false);
    try {
      const DarknetNetwork network = read_darknet_network(changed, "net.cfg");
      if (network.n_weights > 1000000 || network.input.area() > 1000000) continue;
      std::vector<float> weights(network.n_weights);
      for (float& weight : weights) weight = static_cast<float>(random.uniform(0.01, 1.0));
      good += works(changed, weights_file(weights)) ? 1 : 0;
    } catch (const InputError&) {
    }
    EXPECT_GE(good, 1) << "the unchanged one";
  }
  EXPECT_GT(good, 50);
}

TEST_F(BrokenModelTest, ChangedWeights) {
  Random random(12);
  int good = 0;
  for (int i = 0; i < 300; ++i) good += works(config_, mutate(weights_, random, true)) ? 1 : 0;
  EXPECT_GT(good, 0);
  for (int i = 0; i < 100; ++i) works(config_, mutate(weights_, random, false));
}

TEST_F(BrokenModelTest, RandomBytes) {
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    std::string bytes(random.index(2000), '\0');
    for (char& c : bytes) c = static_cast<char>(random.index(256));
    EXPECT_FALSE(works(bytes, weights_));
    EXPECT_FALSE(works("[net]\nwidth=32\nheight=32\nchannels=3\n" + bytes, weights_));
    EXPECT_FALSE(works(config_, bytes));
    bytes.resize(weights_.size());
    works(config_, weights_.substr(0, 20) + bytes.substr(20));
  }
}

TEST_F(BrokenModelTest, MissingFilesAreNamedWithTheWayOut) {
  const auto error = [&] { return input_error([&] { (void)make_detector(settings_); }); };
  const DetectorSettings good = settings_;
  settings_.model_weights = folder_.file("missing.weights");
  EXPECT_THAT(error(), AllOf(HasSubstr("missing.weights"), HasSubstr("--detector none")));
  settings_ = good;
  settings_.model_cfg = folder_.file("missing.cfg");
  EXPECT_THAT(error(), AllOf(HasSubstr("missing.cfg"), HasSubstr("--detector none")));
  settings_.model_cfg.clear();
  EXPECT_THAT(error(), AllOf(HasSubstr("--model CFG WEIGHTS"), HasSubstr("--detector none")));
  settings_ = good;
  folder_.write("net.weights", weights_.substr(0, 40));
  EXPECT_THAT(error(), AllOf(HasSubstr("net.weights' has 40 bytes"),
                             HasSubstr(std::to_string(weights_.size())), HasSubstr("--detector none")));
}

TEST(MakeDetector, MakesWhatIsAskedFor) {
  const TemporaryFolder folder;
  DetectorSettings settings;
  EXPECT_EQ(make_detector(settings), nullptr);
  settings.kind = DetectorKind::kBoxes;
  EXPECT_THAT(input_error([&] { (void)make_detector(settings); }),
              AllOf(HasSubstr("--boxes FILE"), HasSubstr("--detector none")));
  settings.boxes_file = folder.file("missing.txt");
  EXPECT_THAT(input_error([&] { (void)make_detector(settings); }),
              AllOf(HasSubstr("missing.txt"), HasSubstr("--detector none")));
  settings.boxes_file = folder.write("boxes.txt", "1.5 1 2 3 4 0.5\n");
  const std::unique_ptr<PersonDetector> detector = make_detector(settings);
  ASSERT_NE(detector, nullptr);
  EXPECT_EQ(detector->detect({}, 1.5).size(), 1U);
}

}  // namespace
}  // namespace cpslam
