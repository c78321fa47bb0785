#include "detect/yolo_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "detect/generated_network.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

const cv::Vec3b kRedGreen(0, 255, 255);
const cv::Vec3b kRedBlue(255, 0, 255);

class YoloDetectorTest : public testing::Test {
 protected:
  DetectorSettings settings_for(const GeneratedNetwork& network, int version = 2) {
    DetectorSettings settings;
    settings.kind = DetectorKind::kYolo;
    settings.model_cfg = folder_.write("net.cfg", network.config());
    settings.model_weights = folder_.write("net.weights", weights_file(network.weights(), version));
    return settings;
  }

  static std::vector<PersonBox> detect(const DetectorSettings& settings, const cv::Mat& image) {
    return YoloDetector(settings, Log()).detect(image, 0.0);
  }

  static void expect_box(const PersonBox& found, const PersonBox& expected, double tolerance = 1e-3) {
    EXPECT_NEAR(found.x, expected.x, tolerance);
    EXPECT_NEAR(found.y, expected.y, tolerance);
    EXPECT_NEAR(found.width, expected.width, tolerance);
    EXPECT_NEAR(found.height, expected.height, tolerance);
    EXPECT_NEAR(found.confidence, expected.confidence, 1e-4);
  }

  TemporaryFolder folder_;
};

TEST_F(YoloDetectorTest, FindsTheLitCell) {
  GeneratedNetwork network;
  network.n_classes = 1;
  network.offset = {1.0, -0.5};
  network.growth = {0.25, -0.125};
  const DetectorSettings settings = settings_for(network);
  const std::vector<PersonBox> boxes = detect(settings, network.picture({5, 2}, kRedGreen));
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], network.box(0, 0, {5, 2}, GeneratedNetwork::score(1.0, 1.0)));
  EXPECT_TRUE(detect(settings, network.picture({5, 2}, {0, 0, 0})).empty());
  EXPECT_TRUE(detect(settings, network.picture({5, 2}, {0, 255, 0})).empty()) << "class without objectness";
}

TEST_F(YoloDetectorTest, ReadsWeightsOfVersionsBefore02) {
  const GeneratedNetwork network;
  const std::vector<PersonBox> boxes = detect(settings_for(network, 1), network.picture({1, 7}, kRedGreen));
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], network.box(0, 0, {1, 7}, GeneratedNetwork::score(1.0, 1.0)));
}

TEST_F(YoloDetectorTest, ThreeHeadsAnswerEachOnItsOwnGrid) {
  GeneratedNetwork network;
  network.n_classes = 80;
  network.anchors = {{{4.0, 6.0}, {30.0, 4.0}}, {{12.0, 60.0}}, {{50.0, 90.0}}};
  network.scale_x_y = 1.2;
  network.offset = {-2.0, 2.0};
  const std::vector<PersonBox> boxes = detect(settings_for(network), network.picture({7, 10}, kRedGreen));
  ASSERT_EQ(boxes.size(), 4U);
  const double score = GeneratedNetwork::score(1.0, 1.0);
  expect_box(boxes[0], network.box(0, 0, {7, 10}, score));
  expect_box(boxes[1], network.box(0, 1, {7, 10}, score));
  expect_box(boxes[2], network.box(1, 0, {3, 5}, score));
  expect_box(boxes[3], network.box(2, 0, {1, 2}, score));
}

TEST_F(YoloDetectorTest, TellsClassesApart) {
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  const cv::Mat green = network.picture({3, 3}, kRedGreen);
  const cv::Mat blue = network.picture({3, 3}, kRedBlue);
  EXPECT_EQ(detect(settings, green).size(), 1U);
  EXPECT_TRUE(detect(settings, blue).empty());
  settings.classes = {1};
  EXPECT_TRUE(detect(settings, green).empty());
  EXPECT_EQ(detect(settings, blue).size(), 1U);
  settings.classes = {0, 1};
  EXPECT_EQ(detect(settings, green).size(), 1U);
  EXPECT_EQ(detect(settings, blue).size(), 1U);
}

TEST_F(YoloDetectorTest, TakesTheThresholdAtItsWord) {
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  // Half-lit cells score about 0.25 x 0.25; OpenCV's own default would make zeros of them.
  const cv::Mat dim = network.picture({4, 4}, {0, 110, 110});
  const double score = GeneratedNetwork::score(110.0 / 255.0, 110.0 / 255.0);
  ASSERT_LT(score, 0.1);
  settings.confidence_threshold = score + 0.001;
  EXPECT_TRUE(detect(settings, dim).empty());
  settings.confidence_threshold = score - 0.001;
  const std::vector<PersonBox> boxes = detect(settings, dim);
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], network.box(0, 0, {4, 4}, score));
}

TEST_F(YoloDetectorTest, MapsBoxesBackFromTheLetterbox) {
  const GeneratedNetwork network;  // 64 x 96
  // Twice the width: scaled by a half and centred, rows 36 to 59 of the input.
  cv::Mat image(48, 128, CV_8UC3, cv::Scalar::all(0.0));
  cv::rectangle(image, cv::Rect(80, 8, 16, 16), cv::Scalar(kRedGreen), cv::FILLED);
  // In the input: x 40 to 47, y 40 to 47: the whole cell (5, 5).
  const std::vector<PersonBox> boxes = detect(settings_for(network), image);
  ASSERT_EQ(boxes.size(), 1U);
  const PersonBox inside = network.box(0, 0, {5, 5}, GeneratedNetwork::score(1.0, 1.0));
  expect_box(boxes[0], {2.0 * inside.x, 2.0 * (inside.y - 36.0), 16.0, 48.0, inside.confidence});
}

TEST_F(YoloDetectorTest, TakesGreyImagesAndImagesOfChangingSize) {
  const GeneratedNetwork network;
  YoloDetector detector(settings_for(network), Log());
  for (const int factor : {1, 3, 1, 2}) {
    cv::Mat image(factor * network.input.height, factor * network.input.width, CV_8UC1, cv::Scalar(0.0));
    cv::rectangle(image, cv::Rect(factor * 16, factor * 24, factor * 8, factor * 8), 255.0, cv::FILLED);
    const std::vector<PersonBox> boxes = detector.detect(image, 0.0);
    ASSERT_EQ(boxes.size(), 1U);
    const PersonBox inside = network.box(0, 0, {2, 3}, GeneratedNetwork::score(1.0, 1.0));
    expect_box(boxes[0], {factor * inside.x, factor * inside.y, factor * inside.width, factor * inside.height,
                          inside.confidence});
  }
}

TEST_F(YoloDetectorTest, AnotherInputSizeIsAnotherGrid) {
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  settings.input_width = 160;
  GeneratedNetwork wide = network;
  wide.input = {160, 96};
  const YoloDetector detector(settings, Log());
  EXPECT_THAT(detector.name(), HasSubstr("net.weights, 160 x 96"));
  const std::vector<PersonBox> boxes = detect(settings, wide.picture({17, 6}, kRedGreen));
  ASSERT_EQ(boxes.size(), 1U);
  expect_box(boxes[0], wide.box(0, 0, {17, 6}, GeneratedNetwork::score(1.0, 1.0)));

  settings.input_width = 100;
  const std::string error = input_error([&] { YoloDetector(settings, Log()); });
  EXPECT_THAT(error, HasSubstr("net.cfg:2: [net]"));
  EXPECT_THAT(error, HasSubstr("100 x 96 must be a multiple of 8 px"));
}

TEST_F(YoloDetectorTest, ThreadsDoNotChangeTheBoxes) {
  const int before = cv::getNumThreads();
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  settings.confidence_threshold = 0.01;
  const cv::Mat noise = noise_image({200, 300}, CV_8UC3);
  std::vector<std::vector<PersonBox>> results;
  for (const int threads : {1, 2}) {
    settings.n_threads = threads;
    results.push_back(detect(settings, noise));
    EXPECT_EQ(cv::getNumThreads(), threads);
  }
  cv::setNumThreads(before);
  ASSERT_FALSE(results[0].empty());
  ASSERT_EQ(results[0].size(), results[1].size());
  for (std::size_t i = 0; i < results[0].size(); ++i) {
    EXPECT_EQ(results[0][i].x, results[1][i].x);
    EXPECT_EQ(results[0][i].confidence, results[1][i].confidence);
  }
}

TEST_F(YoloDetectorTest, RunsInEightBits) {
  GeneratedNetwork network;
  network.anchors = {{{8.0, 24.0}}, {{40.0, 40.0}}};
  DetectorSettings settings = settings_for(network);
  settings.quantise = true;
  settings.calibration = folder_.file("pictures");
  folder_.write("pictures/a.png", encode(".png", network.picture({1, 1}, kRedGreen)));
  folder_.write("pictures/b.PNG", encode(".png", network.picture({2, 2}, kRedBlue)));
  folder_.write("pictures/notes.txt", "not a picture");
  std::vector<std::string> messages;
  YoloDetector detector(settings, Log([&](LogLevel, const std::string& text) { messages.push_back(text); }));
  EXPECT_THAT(detector.name(), HasSubstr("8-bit"));
  EXPECT_THAT(messages, testing::ElementsAre(HasSubstr("in floats")));
  const std::vector<PersonBox> boxes = detector.detect(network.picture({6, 9}, kRedGreen), 0.0);
  ASSERT_EQ(boxes.size(), 2U);
  // 8 bits over logits from -8 to 8 are steps of a sixteenth.
  for (const PersonBox& expected : {network.box(0, 0, {6, 9}, 0.99), network.box(1, 0, {3, 4}, 0.99)}) {
    const PersonBox& found = (expected.height < 30.0) == (boxes[0].height < 30.0) ? boxes[0] : boxes[1];
    EXPECT_NEAR(found.x, expected.x, 0.05 * expected.width);
    EXPECT_NEAR(found.y, expected.y, 0.05 * expected.height);
    EXPECT_NEAR(found.width, expected.width, 0.07 * expected.width);
    EXPECT_NEAR(found.height, expected.height, 0.07 * expected.height);
    EXPECT_GT(found.confidence, 0.98);
  }
}

TEST_F(YoloDetectorTest, TheBundledNetworkRunsWhenNoneIsNamed) {
  const GeneratedNetwork network;
  folder_.write("models/yc.cfg", network.config());
  folder_.write("models/yc.weights", weights_file(network.weights()));
  ASSERT_EQ(setenv("CPSLAM_DATA", folder_.path().c_str(), 1), 0);
  DetectorSettings settings;
  settings.kind = DetectorKind::kYolo;
  // That of the source tree comes first, if its weights are there.
  const std::optional<DetectorModel> model = bundled_detector_model();
  ASSERT_TRUE(model);
  EXPECT_THAT(model->cfg, HasSubstr("models/yc.cfg"));
  EXPECT_THAT(make_detector(settings)->name(), HasSubstr(model->weights));
  ASSERT_EQ(unsetenv("CPSLAM_DATA"), 0);

  settings.model_weights = model->weights;
  EXPECT_THAT(input_error([&] { (void)make_detector(settings); }),
              testing::AllOf(HasSubstr("--model CFG WEIGHTS"), HasSubstr("--detector none")));
}

TEST_F(YoloDetectorTest, WeakBoxesGoOnFromBoxesBefore) {
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  settings.confidence_threshold = 0.9;
  settings.weak_confidence_threshold = 0.2;
  const cv::Mat sure = network.picture({3, 3}, kRedGreen);
  const cv::Mat weak = network.picture({3, 3}, kRedGreen * 0.52);
  const double score = GeneratedNetwork::score(132.0 / 255.0, 132.0 / 255.0);
  ASSERT_TRUE(score > 0.25 && score < 0.8) << score;
  const std::unique_ptr<PersonDetector> detector = make_yolo_detector(settings, Log());
  EXPECT_TRUE(detector->detect(weak, 1.0).empty());
  EXPECT_EQ(detector->detect(sure, 1.1).size(), 1U);
  EXPECT_EQ(detector->detect(weak, 1.2).size(), 1U);
  settings.weak_confidence_threshold = 0.9;
  const std::unique_ptr<PersonDetector> plain = make_yolo_detector(settings, Log());
  EXPECT_EQ(plain->detect(sure, 1.1).size(), 1U);
  EXPECT_TRUE(plain->detect(weak, 1.2).empty());
}

TEST_F(YoloDetectorTest, RefusesToRunANetworkThatEightBitsRuin) {
  const GeneratedNetwork network;
  DetectorSettings settings = settings_for(network);
  for (int i = 0; i < 4; ++i)
    folder_.write("lit/" + std::to_string(i) + ".png",
                  encode(".png", network.picture({i, 2 * i}, kRedGreen)));
  settings.calibration = folder_.file("lit");
  settings.quantise = true;
  EXPECT_NO_THROW(YoloDetector(settings, Log()));
  std::vector<float> weights = network.weights();
  weights[2] = 1e4F;  // blue, of class 1, leaves red and green no steps of their own
  folder_.write("net.weights", weights_file(weights));
  settings.model_weights = folder_.file("net.weights");
  EXPECT_THAT(
      input_error([&] { YoloDetector(settings, Log()); }),
      testing::AllOf(HasSubstr("8-bit integers ruin"), HasSubstr("of 4 people"), HasSubstr("finds 0")));
  settings.quantise = false;
  YoloDetector detector(settings, Log());
  EXPECT_EQ(detector.detect(network.picture({1, 1}, kRedGreen), 0.0).size(), 1U);
}

TEST_F(YoloDetectorTest, SaysWhatCalibrationLacks) {
  DetectorSettings settings = settings_for(GeneratedNetwork());
  settings.quantise = true;
  const auto error = [&] { return input_error([&] { YoloDetector(settings, Log()); }); };
  EXPECT_THAT(error(), HasSubstr("needs a folder of pictures"));
  settings.calibration = folder_.file("nowhere");
  EXPECT_THAT(error(), HasSubstr(settings.calibration));
  folder_.write("empty/readme.txt", "nothing here");
  settings.calibration = folder_.file("empty");
  EXPECT_THAT(error(), HasSubstr("no pictures (.png, .jpg) in the folder"));
  const std::string picture = encode(".png", noise_image({64, 64}, CV_8UC3));
  folder_.write("broken/cut.png", picture.substr(0, picture.size() / 2));
  settings.calibration = folder_.file("broken");
  EXPECT_THAT(error(), HasSubstr("cut.png"));
}

TEST_F(YoloDetectorTest, RefusesWhatMakesNoSense) {
  const GeneratedNetwork network;
  const DetectorSettings good = settings_for(network);
  const auto error = [&](const auto& change) {
    DetectorSettings settings = good;
    change(settings);
    return input_error([&] { YoloDetector(settings, Log()); });
  };
  EXPECT_THAT(error([](DetectorSettings& s) { s.classes = {2}; }), HasSubstr("no class 2: those of"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.classes = {-1}; }), HasSubstr("no class -1"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.classes = {}; }), HasSubstr("no class of"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.confidence_threshold = 0.0; }),
              HasSubstr("Detector.confidenceThreshold"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.weak_confidence_threshold = 1.5; }),
              HasSubstr("Detector.weakConfidenceThreshold"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.nms_threshold = 1.5; }), HasSubstr("Detector.nmsThreshold"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.input_width = -32; }), HasSubstr("Detector.inputWidth"));
  EXPECT_THAT(error([](DetectorSettings& s) { s.input_height = 100000; }), HasSubstr("at most 4096"));

  YoloDetector detector(good, Log());
  EXPECT_THROW((void)detector.detect(cv::Mat(), 0.0), InputError);
  EXPECT_THROW((void)detector.detect(cv::Mat(48, 64, CV_16UC1, cv::Scalar(1.0)), 0.0), InputError);
  EXPECT_EQ(detector.detect(network.picture({0, 0}, kRedGreen), 0.0).size(), 1U) << "works after an error";
}

}  // namespace
}  // namespace cpslam
