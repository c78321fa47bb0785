#include "detect/darknet_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <opencv2/core/version.hpp>

#include "detect/generated_network.h"
#include "detect/yolo_network.h"
#include "io/error_text.h"
#include "io/temporary_folder.h"
#include "support/shared_data.h"
#include "util/random.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

std::string conv(int filters, int size, int stride, const std::string& activation, bool normalise = true) {
  return std::string("[convolutional]\nbatch_normalize=") + std::to_string(normalise ? 1 : 0) +
         "\nfilters=" + std::to_string(filters) + "\nsize=" + std::to_string(size) +
         "\nstride=" + std::to_string(stride) + "\npad=1\nactivation=" + activation + "\n";
}

std::string head(int classes, const std::string& mask) {
  return conv(3 * (5 + classes), 1, 1, "linear", false) + "[yolo]\nmask=" + mask +
         "\nanchors=10,14, 23,27, 37,58, 81,82, 135,169, 344,319\nclasses=" + std::to_string(classes) +
         "\nnum=6\nscale_x_y=1.05\n";
}

/// Three cross-stage partial blocks and a two-headed pyramid: the layout of YOLOv4-tiny (Wang et al. 2021).
std::string tiny_config(int classes, const std::string& activation) {
  std::string text = "[net]\nwidth=416\nheight=416\nchannels=3\n";
  text += conv(32, 3, 2, activation) + conv(64, 3, 2, activation);
  for (const int width : {64, 128, 256}) {
    text += conv(width, 3, 1, activation) + "[route]\nlayers=-1\ngroups=2\ngroup_id=1\n";
    text += conv(width / 2, 3, 1, activation) + conv(width / 2, 3, 1, activation) + "[route]\nlayers=-1,-2\n";
    text += conv(width, 1, 1, activation) + "[route]\nlayers=-6,-1\n[maxpool]\nsize=2\nstride=2\n";
  }
  text += conv(512, 3, 1, activation) + conv(256, 1, 1, activation) + conv(512, 3, 1, activation);
  text += head(classes, "3,4,5") + "[route]\nlayers=-4\n" + conv(128, 1, 1, activation);
  text += "[upsample]\nstride=2\n[route]\nlayers=-1,23\n" + conv(256, 3, 1, activation);
  return text + head(classes, "0,1,2");
}

std::vector<float> random_weights(std::size_t count) {
  Random random(3);
  std::vector<float> weights(count);
  // Positive, so that variances are variances.
  for (float& weight : weights) weight = static_cast<float>(random.uniform(0.01, 0.02));
  return weights;
}

TEST(DarknetNetwork, KnowsYoloV4Tiny) {
  const DarknetNetwork network = read_darknet_network(tiny_config(80, "leaky"), "tiny.cfg");
  // The published yolov4-tiny.weights has 24 251 276 bytes, 20 of them the header.
  EXPECT_EQ(network.n_weights, (24251276U - 20U) / 4U);
  ASSERT_EQ(network.layers.size(), 38U);
  EXPECT_EQ(network.layers[3].kind, "route");
  EXPECT_EQ(network.layers[3].output, (DarknetShape{104, 104, 32}));
  EXPECT_EQ(network.layers[9].output, (DarknetShape{52, 52, 128}));
  EXPECT_EQ(network.layers[25].output, (DarknetShape{13, 13, 512}));
  EXPECT_EQ(network.layers[34].output, (DarknetShape{26, 26, 384}));
  ASSERT_EQ(network.heads.size(), 2U);
  EXPECT_EQ(network.heads[0].stride, 32);
  EXPECT_EQ(network.heads[0].grid_width, 13);
  EXPECT_EQ(network.heads[0].anchors_px[2], cv::Size2d(344.0, 319.0));
  EXPECT_EQ(network.heads[1].stride, 16);
  EXPECT_EQ(network.heads[1].anchors_px[0], cv::Size2d(10.0, 14.0));
  EXPECT_EQ(network.heads[1].scale_x_y, 1.05);
  EXPECT_EQ(network.n_classes, 80);
}

TEST(DarknetNetwork, AnotherInputSizeChangesTheGrids) {
  const DarknetNetwork network = read_darknet_network(tiny_config(1, "swish"), "tiny.cfg", {608, 0});
  EXPECT_EQ(network.input, cv::Size(608, 416));
  EXPECT_EQ(network.heads[0].grid_width, 19);
  EXPECT_EQ(network.heads[0].grid_height, 13);
  EXPECT_THAT(input_error([] {
                (void)read_darknet_network(tiny_config(1, "swish"), "tiny.cfg", {0, 400});
              }),
              HasSubstr("tiny.cfg:1: [net] the input size 416 x 400 must be a multiple of 32 px"));
}

TEST(DarknetNetwork, OpenCvAgreesOnEveryShape) {
  // The constructor compares what OpenCV makes of the file with our shapes.
  const TemporaryFolder folder;
  for (const std::string activation : {"leaky", "swish", "mish", "relu", "logistic"}) {
    const std::string text = tiny_config(3, activation);
    const DarknetNetwork network = read_darknet_network(text, "tiny.cfg");
    const std::string weights = folder.write("tiny.weights", weights_file(random_weights(network.n_weights)));
    EXPECT_NO_THROW(YoloNetwork(folder.write("tiny.cfg", text), weights, {96, 64})) << activation;
  }
}

TEST(YoloNetwork, RunsEveryActivationInEightBits) {
  const TemporaryFolder folder;
  for (const std::string activation : {"leaky", "swish", "mish", "relu", "logistic"}) {
    const std::string text = tiny_config(2, activation);
    const DarknetNetwork description = read_darknet_network(text, "tiny.cfg");
    const std::string weights =
        folder.write("tiny.weights", weights_file(random_weights(description.n_weights)));
    YoloNetwork network(folder.write("tiny.cfg", text), weights, {96, 64});
    const std::vector<cv::Mat> pictures(3, cv::Mat(64, 96, CV_8UC3, cv::Scalar(10.0, 100.0, 200.0)));
    EXPECT_NO_THROW(network.quantise(pictures)) << activation;
    EXPECT_NO_THROW((void)network.run(pictures.front())) << activation;
  }
}

TEST(DarknetNetwork, OpenCvAgreesOnPaddingGroupsAndShortcuts) {
  const TemporaryFolder folder;
  for (const std::string layer :
       {"[maxpool]\nsize=2\nstride=1\n", "[maxpool]\nsize=13\nstride=1\n", "[maxpool]\nsize=3\nstride=2\n",
        "[maxpool]\nsize=3\nstride=2\npadding=0\n",
        "[convolutional]\nfilters=8\nsize=3\npadding=2\nactivation=leaky\n",
        "[convolutional]\nfilters=8\nsize=5\nstride=2\nactivation=leaky\n",
        "[convolutional]\ngroups=8\nfilters=8\nsize=4\npad=1\nactivation=swish\n",
        "[convolutional]\nfilters=8\nsize=1\nactivation=leaky\n[shortcut]\nfrom=-2\nactivation=linear\n",
        "[convolutional]\nfilters=8\nsize=1\nactivation=leaky\n[shortcut]\nfrom=0\nactivation=leaky\n",
        "[dropout]\nprobability=0.5\n[upsample]\nstride=2\n[route]\nlayers=-1,-1\n"}) {
    const std::string text =
        "[net]\nwidth=64\nheight=96\nchannels=3\n" + conv(8, 3, 2, "leaky") + layer + head(2, "0,1,2");
    const DarknetNetwork network = read_darknet_network(text, "net.cfg");
    const std::string weights = folder.write("net.weights", weights_file(random_weights(network.n_weights)));
    EXPECT_NO_THROW(YoloNetwork(folder.write("net.cfg", text), weights, {})) << layer;
  }
}

TEST(DarknetNetwork, NamesFileLineAndSection) {
  const std::string net = "[net]\nwidth=64\nheight=64\nchannels=3\n";
  const std::string good = conv(8, 3, 2, "leaky");
  struct Case {
    std::string text;
    std::string error;
  };
  const std::vector<Case> cases{
      {"", "'x.cfg' describes no network"},
      {net, "'x.cfg' describes no network"},
      {"width=3\n" + net, "x.cfg:1: a Darknet .cfg begins with the section [net]"},
      {"[yolo]\n" + net, "x.cfg:1: a Darknet .cfg begins with the section [net]"},
      {net + "what is this\n" + good, "x.cfg:5: 'whatisthis' is not of the form"},
      {net + "width=32\n" + good, "x.cfg:5: [net] 'width' has another value in line 2"},
      {"[net]\nwidth=64\nheight=x\nchannels=3\n" + good, "x.cfg:3: [net] height: 'x' is not a number"},
      {"[net]\nwidth=64\nheight=64\nchannels=1\n" + good, "x.cfg:4: [net] channels must be 3"},
      {"[net]\nheight=64\nchannels=3\n" + good, "x.cfg:1: [net] lacks 'width='"},
      {net + "[connected]\noutput=9\n", "x.cfg:5: [connected] is a kind of layer that is not supported"},
      {net + "[convolutional]\nfilters=-1\nsize=1\nactivation=linear\n",
       "x.cfg:6: [convolutional] filters: -1"},
      {net + "[convolutional]\nfilters=2.5\nsize=1\nactivation=linear\n", "'2.5' is not a whole number"},
      {net + "[convolutional]\nfilters=8\nsize=1\nactivation=silu\n",
       "x.cfg:8: [convolutional] activation must"},
      {net + "[convolutional]\nfilters=8\nsize=1\ngroups=2\nactivation=relu\n",
       "x.cfg:8: [convolutional] groups"},
      {net + "[convolutional]\nfilters=8\nsize=1\nantialiasing=1\nactivation=relu\n", "antialiasing= is not"},
      {net + conv(8, 1, 64, "relu") + conv(8, 1, 64, "relu") + good, "nothing is left of the input"},
      {net + "[maxpool]\nsize=64\nstride=1\npadding=0\n[convolutional]\nfilters=1\nsize=3\nactivation=relu\n",
       "the window is larger than its input"},
      {net + good + "[route]\nlayers=-2\n", "x.cfg:13: [route] layers: there is no layer -2 before this one"},
      {net + good + "[route]\nlayers=1\n", "there is no layer 1 before this one"},
      {net + good + good + "[route]\nlayers=-1,-2\n", "joins layers of different sizes"},
      {net + good + conv(4, 1, 1, "leaky") + "[shortcut]\nfrom=-2\n", "adds layers of different shapes"},
      {net + good + "[upsample]\nstride=4\n", "makes more of the input than it had"},
      {net + good, "is the last section, but there was no [yolo]"},
      {net + good + head(81, "0,1,2"), "classes: 81 is outside 1 to 80"},
      {net + good + head(3, "0,1"), "takes 16 channels, anchors x (5 + classes), but gets 24"},
      {net + good + head(3, "0,1,6"), "mask: 6 is outside 0 to 5"},
      {net + good + head(3, "0,1,2") + "[route]\nlayers=0\n" + head(2, "0,1,2"), "as many classes"},
      {"[net]\nwidth=4096\nheight=4096\nchannels=3\n" + conv(64, 3, 1, "leaky"), "too large"},
  };
  for (const Case& entry : cases) {
    EXPECT_THAT(input_error([&] { (void)read_darknet_network(entry.text, "x.cfg"); }), HasSubstr(entry.error))
        << entry.text;
  }
  const std::string four = net + good + head(1, "0,1,2") + "[route]\nlayers=0\n" + head(1, "0,1,2") +
                           "[route]\nlayers=0\n" + head(1, "0,1,2") + "[route]\nlayers=0\n" +
                           head(1, "0,1,2");
  EXPECT_THAT(input_error([&] { (void)read_darknet_network(four, "x.cfg"); }),
              HasSubstr("one head too many"));
}

TEST(DarknetWeights, AreMeasuredAgainstTheConfig) {
  const GeneratedNetwork generated;
  const DarknetNetwork network = read_darknet_network(generated.config(), "x.cfg");
  std::vector<float> weights = generated.weights();
  ASSERT_EQ(network.n_weights, weights.size());
  const std::string whole = weights_file(weights);
  const auto error = [&](const std::string& bytes) {
    return input_error([&] { check_darknet_weights(bytes, "x.weights", network, "x.cfg"); });
  };
  EXPECT_NO_THROW(check_darknet_weights(whole, "x.weights", network, "x.cfg"));
  EXPECT_NO_THROW(check_darknet_weights(weights_file(weights, 1), "x.weights", network, "x.cfg"));
  for (const std::size_t size : {whole.size() - 1, whole.size() - 4, whole.size() / 2, std::size_t{12}}) {
    const std::string text = error(whole.substr(0, size));
    EXPECT_THAT(text, HasSubstr("'x.weights' has " + std::to_string(size) + " bytes, but 'x.cfg' asks for " +
                                std::to_string(whole.size())));
    EXPECT_THAT(text, HasSubstr("it was cut off"));
  }
  EXPECT_THAT(error(whole + "1234"), HasSubstr("something was added"));
  EXPECT_THAT(error(whole.substr(0, 11)), HasSubstr("too short"));
  EXPECT_THAT(error(std::string(whole.size(), 'x')), HasSubstr("not a Darknet .weights file"));
  weights[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error(weights_file(weights)), HasSubstr("the number at byte 48 is not finite"));
}

TEST(YoloNetwork, RefusesWeightsThatGiveNoNumbers) {
  if (CV_VERSION_MAJOR > 4 || CV_VERSION_MINOR > 6)
    GTEST_SKIP() << "the overflow below gives no numbers with OpenCV 4.6, but finite ones with 4.10";
  const TemporaryFolder folder;
  const GeneratedNetwork generated;
  std::vector<float> weights = generated.weights();
  // Red and green grow beyond all numbers, and where the box lies is their difference.
  weights[3] = weights[4] = 1e30F;
  weights[21 + 7] = 1e20F;
  weights[21 + 7 + 1] = -1e20F;
  const std::string config = folder.write("x.cfg", generated.config());
  const std::string path = folder.write("x.weights", weights_file(weights));
  EXPECT_THAT(input_error([&] { YoloNetwork(config, path, {}); }), HasSubstr("gives no numbers"));
}

TEST(YoloNetwork, RefusesOutputsThatAreNoHeads) {
  const TemporaryFolder folder;
  const GeneratedNetwork generated;
  const std::string text = generated.config() + "[route]\nlayers=0\n[maxpool]\nsize=2\nstride=2\n";
  const std::string config = folder.write("x.cfg", text);
  const std::string path = folder.write("x.weights", weights_file(generated.weights()));
  EXPECT_THAT(input_error([&] { YoloNetwork(config, path, {}); }),
              HasSubstr("outputs other than its [yolo]"));
}

TEST(DarknetNetwork, ReferenceDetectorFitsItsWeights) {
  const std::filesystem::path path =
      shared_data_dir() / "reference_detectors/yolo-fastest-1.1-xl/yolo-fastest-1.1-xl";
  if (!std::filesystem::exists(path.string() + ".cfg")) GTEST_SKIP() << "no " << path << ".cfg";
  const DarknetNetwork network =
      read_darknet_network(TemporaryFolder::content(path.string() + ".cfg"), path.string() + ".cfg");
  EXPECT_EQ(network.n_weights, (std::filesystem::file_size(path.string() + ".weights") - 20U) / 4U);
  EXPECT_EQ(network.n_classes, 80);
  ASSERT_EQ(network.heads.size(), 2U);
  EXPECT_EQ(network.heads[0].stride, 32);
  EXPECT_EQ(network.heads[1].stride, 16);
}

}  // namespace
}  // namespace cpslam
