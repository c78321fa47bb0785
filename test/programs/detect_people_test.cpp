// detect_people, on a network that lights up where a picture does.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "detect/generated_network.h"
#include "io/person_boxes.h"
#include "io/temporary_folder.h"
#include "io/test_images.h"
#include "programs/program_run.h"

namespace cpslam {
namespace {

using testing::HasSubstr;

const cv::Vec3b kPerson(0, 255, 255);    // class 0
const cv::Vec3b kOther(255, 0, 255);     // class 1
const cv::Vec3b kHalfSeen(0, 110, 110);  // class 0, hardly confident

class DetectPeople : public testing::Test {
 protected:
  DetectPeople() {
    folder_.write("model/net.cfg", network_.config());
    folder_.write("model/net.weights", weights_file(network_.weights()));
  }
  [[nodiscard]] std::string picture(const std::string& name, cv::Point cell, const cv::Vec3b& bgr) const {
    return folder_.write(name, encode(".png", network_.picture(cell, bgr)));
  }
  [[nodiscard]] static ProgramResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), DETECT_PEOPLE_PATH);
    return run_program(arguments);
  }
  /// With the network of this test.
  [[nodiscard]] ProgramResult detect(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(),
                     {"--model", folder_.file("model/net.cfg"), folder_.file("model/net.weights")});
    return run(arguments);
  }
  /// The line of the box that a cell lit in full gives.
  [[nodiscard]] std::string line(const std::string& key, cv::Point cell) const {
    return key + " " + to_text(network_.box(0, 0, cell, GeneratedNetwork::score(1.0, 1.0))) + "\n";
  }
  [[nodiscard]] nlohmann::json report(const std::string& name = "report.json") const {
    return nlohmann::json::parse(TemporaryFolder::content(folder_.file(name)));
  }

  GeneratedNetwork network_;
  TemporaryFolder folder_;
};

TEST_F(DetectPeople, PrintsTheBoxesOfAPicture) {
  const std::string path = picture("a b.png", {5, 2}, kPerson);
  const ProgramResult result = detect({path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, line(path, {5, 2}));
  EXPECT_THAT(result.err, HasSubstr("1: 1 boxes"));
  EXPECT_EQ(detect({path, "--quiet"}).err, "");
}

TEST_F(DetectPeople, ListsAreRelativeToThemselvesAndKeepTheirNames) {
  (void)picture("images/a b.png", {1, 1}, kPerson);
  (void)picture("images/c.png", {6, 9}, kPerson);
  (void)picture("images/nobody.png", {6, 9}, kOther);
  const std::string list =
      folder_.write("list.txt", "images/c.png\r\n# no picture\n\n  images/a b.png\nimages/nobody.png\n");
  const std::string boxes = folder_.file("boxes.txt");
  const ProgramResult result = detect({list, "--output", boxes, "--report", folder_.file("report.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(TemporaryFolder::content(boxes), line("images/c.png", {6, 9}) + line("images/a b.png", {1, 1}));
  EXPECT_THAT(result.out, HasSubstr("pictures    3: 2 boxes of confidence 0.6"));
  EXPECT_THAT(result.out, HasSubstr("ms a picture (median)"));
  const nlohmann::json json = report();
  EXPECT_EQ(json["boxes"], 2);
  ASSERT_EQ(json["pictures"].size(), 3U);
  EXPECT_EQ(json["pictures"][1]["picture"], "images/a b.png");
  EXPECT_EQ(json["pictures"][2]["boxes"], 0);
  EXPECT_EQ(json["pictures"][2]["width"], 64);
  EXPECT_EQ(json["pictures"][2]["height"], 96);
  EXPECT_GT(json["detection_ms"]["p50"], 0.0);
  EXPECT_LE(json["detection_ms"]["p50"], json["detection_ms"]["p95"]);
  EXPECT_TRUE(json["compared"].is_null());
}

TEST_F(DetectPeople, AFolderIsReadInTheOrderOfItsNames) {
  const std::string second = picture("pictures/b.png", {2, 2}, kPerson);
  const std::string first = picture("pictures/a.PNG", {3, 3}, kPerson);
  folder_.write("pictures/notes.txt", "no picture");
  EXPECT_EQ(detect({folder_.file("pictures")}).out, line(first, {3, 3}) + line(second, {2, 2}));
}

TEST_F(DetectPeople, OfASequenceBoxesAreListedByStampAsRgbdTumTakesThem) {
  (void)picture("office/rgb/1.png", {1, 1}, kPerson);
  (void)picture("office/rgb/2.png", {2, 2}, kPerson);
  folder_.write("office/rgb.txt", "# timestamp filename\n10.5 rgb/1.png\n10.533334 rgb/2.png\n");
  const std::string boxes = folder_.file("boxes.txt");
  EXPECT_EQ(detect({folder_.file("office"), "--output", boxes}).exit_code, 0);
  EXPECT_EQ(TemporaryFolder::content(boxes), line("10.500000", {1, 1}) + line("10.533334", {2, 2}));
  const std::vector<StampedBoxes> frames = read_person_boxes(boxes);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].time_s, 10.533334);
  EXPECT_NEAR(frames[1].boxes.at(0).x, network_.box(0, 0, {2, 2}, 1.0).x, 0.006);
}

TEST_F(DetectPeople, OnlyInASequenceWeakBoxesGoOn) {
  (void)picture("office/rgb/1.png", {1, 1}, kHalfSeen);
  (void)picture("office/rgb/2.png", {1, 1}, kPerson);
  (void)picture("office/rgb/3.png", {1, 1}, kHalfSeen);
  folder_.write("office/rgb.txt", "10.50 rgb/1.png\n10.53 rgb/2.png\n10.56 rgb/3.png\n");
  const ProgramResult sequence = detect({folder_.file("office"), "--weak-confidence", "0.01"});
  EXPECT_EQ(lines_of(sequence.out).size(), 2U) << sequence.out;
  EXPECT_THAT(sequence.err, HasSubstr("and of 0.01 and more where they go on from a box before"));
  const ProgramResult pictures = detect({folder_.file("office/rgb"), "--weak-confidence", "0.01"});
  EXPECT_EQ(lines_of(pictures.out).size(), 1U) << pictures.out;
  EXPECT_EQ(lines_of(detect({folder_.file("office"), "--quiet"}).out).size(), 1U);
}

TEST_F(DetectPeople, ClassesGoByIndexOrByTheNamesBesideTheNetwork) {
  const std::string other = picture("other.png", {4, 4}, kOther);
  EXPECT_EQ(detect({other, "--quiet"}).out, "");
  EXPECT_EQ(detect({other, "--quiet", "--classes", "0,1"}).out, line(other, {4, 4}));
  expect_refused(detect({other, "--classes", "dog"}), {"--classes dog", "no .names file", "net.cfg"});
  folder_.write("model/animals.names", "person\r\nprairie dog\r\n");
  EXPECT_EQ(detect({other, "--quiet", "--classes", "prairie dog"}).out, line(other, {4, 4}));
  expect_refused(detect({other, "--classes", "cat"}), {"--classes cat", "animals.names"});
  folder_.write("model/net.names", "dog\nperson\n");
  EXPECT_EQ(detect({other, "--quiet", "--classes", "person"}).out, line(other, {4, 4}))
      << "its own names come first";
  expect_refused(detect({other, "--classes", "7"}), {"no class 7"});
}

TEST_F(DetectPeople, TheNetworksOptionsReachIt) {
  const std::string dim = picture("dim.png", {4, 4}, kHalfSeen);
  EXPECT_EQ(detect({dim, "--quiet"}).out, "");
  EXPECT_EQ(lines_of(detect({dim, "--quiet", "--confidence", "0.01"}).out).size(), 1U);
  const ProgramResult result = detect({dim, "--input-size", "128x64", "--nms", "0.9", "--detector-threads",
                                       "1", "--report", folder_.file("report.json")});
  EXPECT_THAT(result.err, HasSubstr("128 x 64"));
  const nlohmann::json settings = report()["settings"];
  EXPECT_EQ(settings["nms_threshold"], 0.9);
  EXPECT_EQ(settings["n_threads"], 1);
  EXPECT_EQ(settings["input_width"], 128);
  EXPECT_THAT(detect({dim, "--input-size", "96"}).err, HasSubstr("96 x 96"));
  for (const char* const size :
       {"", "x64", "64x", "0", "64x64x64", "-8", "5000", "9999999999999", "64 x 64"}) {
    expect_refused(detect({dim, std::string("--input-size=") + size}), {"--input-size"});
  }
  expect_refused(detect({dim, "--input-size", "60"}), {"net.cfg", "multiple of 8"});
  expect_refused(detect({dim, "--confidence", "0"}), {"--confidence"});
}

TEST_F(DetectPeople, EightBitsAreComparedWithFloats) {
  const std::string lit = picture("pictures/a.png", {3, 3}, kPerson);
  (void)picture("pictures/b.png", {2, 2}, kOther);
  const std::string floats = folder_.file("floats.txt");
  const ProgramResult result = detect({folder_.file("pictures"), "--quantise", folder_.file("pictures"),
                                       "--compare-float", floats, "--report", folder_.file("report.json")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(TemporaryFolder::content(floats), line(lit, {3, 3}));
  EXPECT_EQ(lines_of(result.out).size(), 1U);
  EXPECT_THAT(result.err, HasSubstr("8-bit / float"));
  const nlohmann::json json = report();
  EXPECT_THAT(json["network"].get<std::string>(), HasSubstr("8-bit"));
  EXPECT_GT(json["compared"]["float_ms"]["p50"], 0.0);
  const auto ratio = [&](std::size_t i) {
    return json["pictures"][i]["ms"].get<double>() / json["pictures"][i]["float_ms"].get<double>();
  };
  EXPECT_NEAR(json["compared"]["time_ratio"]["p50"], std::min(ratio(0), ratio(1)), 1e-9)
      << "nearest rank of two";
  expect_refused(detect({lit, "--compare-float", floats}), {"--compare-float", "--quantise"});
}

TEST_F(DetectPeople, UnreadablePicturesAreNamedAndLeftOut) {
  const std::string good = picture("p/good.png", {3, 3}, kPerson);
  const std::string bytes = TemporaryFolder::content(good);
  folder_.write("p/cut.png", bytes.substr(0, bytes.size() / 2));
  folder_.write("p/text.png", "hello");
  const std::string list = folder_.write("p/list.txt", "cut.png\ngone.png\ngood.png\ntext.png\n");
  const ProgramResult result = detect({list, "--quiet", "--report", folder_.file("report.json")});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, line("good.png", {3, 3}));
  EXPECT_EQ(lines_of(result.err).size(), 3U) << result.err;
  for (const char* const name : {"cut.png", "gone.png", "text.png"})
    EXPECT_EQ(count_lines(result.err, std::string("picture ") + name + " left out"), 1U);
  EXPECT_EQ(report()["left_out"], (nlohmann::json{"cut.png", "gone.png", "text.png"}));
  const std::string none = folder_.write("p/none.txt", "text.png\n");
  EXPECT_EQ(detect({none, "--quiet"}).exit_code, 2);
}

TEST_F(DetectPeople, SaysWhatIsWrong) {
  const std::string lit = picture("lit.png", {3, 3}, kPerson);
  expect_refused(run({}), {"PICTURES", "--help"});
  expect_refused(detect({"nowhere.jpg"}), {"nowhere.jpg"});
  expect_refused(detect({folder_.file("nowhere.txt")}), {"nowhere.txt"});
  expect_refused(detect({folder_.write("empty.txt", "\n# nothing\n")}), {"empty.txt", "no picture"});
  std::filesystem::create_directory(folder_.file("empty"));
  expect_refused(detect({folder_.file("empty")}), {"empty", "no pictures"});
  folder_.write("sequence/rgb.txt", "1.0 a.png\n1.0 b.png\n");
  expect_refused(detect({folder_.file("sequence")}), {"rgb.txt:2"});
  expect_refused(detect({lit, "--output", "/no/such/folder/boxes.txt"}), {"--output", "/no/such/folder"});
  expect_refused(detect({lit, "--report", folder_.path()}), {"--report", "is a folder"});
  expect_refused(run({lit, "--model", folder_.file("model/net.cfg"), folder_.file("no.weights")}),
                 {"no.weights"});
  expect_refused(run({lit, "--model", folder_.file("model/net.cfg")}), {"--model"});
  const ProgramResult full = detect({lit, "--quiet", "--output", "/dev/full"});
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.err, HasSubstr("/dev/full"));
}

TEST_F(DetectPeople, CtrlCKeepsWhatWasFound) {
  std::string paths;
  (void)picture("lit.png", {3, 3}, kPerson);
  for (int i = 0; i < 20000; ++i) paths += "lit.png\n";
  const std::string list = folder_.write("long.txt", paths), boxes = folder_.file("boxes.txt");
  const ProgramResult result = run_program({DETECT_PEOPLE_PATH, list, "--output", boxes, "--model",
                                            folder_.file("model/net.cfg"), folder_.file("model/net.weights")},
                                           {SIGINT, "10 %"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("interrupted"));
  const std::size_t found = lines_of(TemporaryFolder::content(boxes)).size();
  EXPECT_GE(found, 2000U);
  EXPECT_LT(found, 20000U);
}

}  // namespace
}  // namespace cpslam
