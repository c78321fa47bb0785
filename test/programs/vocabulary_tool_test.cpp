// vocabulary_tool: a vocabulary trained on pictures, shown, converted, and used by rgbd_tum.
#include <gmock/gmock.h>

#include <filesystem>

#include "place/vocabulary_file.h"
#include "programs/office_sequence.h"

namespace cpslam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

ProgramResult run_tool(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), VOCABULARY_TOOL_PATH);
  return run_program(arguments);
}

/// Three children a node, two levels, in the text format of public ORB vocabularies: "k L scoring weighting",
/// then for each node its parent, whether it is a leaf, 32 bytes and a weight.
std::string public_text() {
  const auto node = [](int parent, bool leaf, int byte, const char* weight) {
    std::string line = std::to_string(parent) + (leaf ? " 1" : " 0");
    for (int i = 0; i < 32; ++i) line.append(" ").append(std::to_string(byte));
    return line + " " + weight + " \n";
  };
  std::string text = "3 2 0 0 \n";
  for (const int byte : {0, 15, 255}) text += node(0, false, byte, "0");
  for (int parent = 1; parent <= 3; ++parent) {
    for (const int byte : {1, 30, 254}) text += node(parent, true, byte * parent % 256, "1.5");
  }
  return text;
}

TEST(VocabularyTool, TrainsOnSequencesAndListsTheSameBytesForTheSameSeed) {
  const OfficeSequence office;
  const std::string list = office.folder().write("list.txt", "office/" + office.colour(3) + "\n");
  const auto train = [&](const std::string& name, const std::string& seed) {
    return run_tool({"train", office.folder().file(name), office.path(), list, "--every", "4", "--branching",
                     "4", "--levels", "3", "--features", "300", "--seed", seed});
  };
  const ProgramResult result = train("office.voc", "7");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("pictures    4\n"));  // every fourth of twelve, and the list's
  EXPECT_THAT(result.out, HasSubstr("by level    1, 4, 16, "));
  ASSERT_EQ(train("again.voc", "7").exit_code, 0);
  ASSERT_EQ(train("other.voc", "8").exit_code, 0);
  const auto content = [&](const std::string& name) {
    return TemporaryFolder::content(office.folder().file(name));
  };
  EXPECT_TRUE(content("office.voc") == content("again.voc"));
  EXPECT_FALSE(content("office.voc") == content("other.voc"));
  EXPECT_EQ(load_vocabulary(office.folder().file("office.voc")).tree().branching, 4U);
}

TEST(VocabularyTool, WhatItTrainedRecognisesPlacesInRgbdTum) {
  const OfficeSequence office;
  const std::string vocabulary = office.folder().file("office.voc");
  ASSERT_EQ(run_tool({"train", vocabulary, office.path(), "--levels", "3", "--quiet"}).out, "");
  const std::string map = office.folder().file("office.map");
  const auto track = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{vocabulary, office.settings(), office.path(),  "--detector",
                                 "none",     "--output",        office.output()};
    all.insert(all.end(), more.begin(), more.end());
    return run_rgbd_tum(all);
  };
  const ProgramResult mapping = track({"--save-map", map});
  ASSERT_EQ(mapping.exit_code, 0) << mapping.err;
  const ProgramResult localising = track({"--load-map", map, "--localization"});
  ASSERT_EQ(localising.exit_code, 0) << localising.err;
  EXPECT_EQ(office.stats()["tracked"], OfficeSequence::kFrames);
}

TEST(VocabularyTool, ConvertsThePublicTextFormat) {
  const TemporaryFolder folder;
  const std::string text = folder.write("ORBvoc.txt", public_text());
  const std::string binary = folder.file("ORBvoc.voc");
  const ProgramResult converted = run_tool({"convert", text, binary});
  ASSERT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_THAT(converted.out, HasSubstr("branching   3\nlevels      2\nnodes       13\nwords       9\n"));
  EXPECT_THAT(converted.out, HasSubstr("by level    1, 3, 9 nodes"));
  const ProgramResult info = run_tool({"info", binary});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  const std::string size = std::to_string(fs::file_size(binary));
  EXPECT_EQ(info.out, "file        " + binary + ", " + size + " bytes\n" + converted.out);
  // The text says the same of itself.
  EXPECT_THAT(run_tool({"info", text}).out, HasSubstr(converted.out));
}

TEST(VocabularyTool, RefusesWhatItCannotUseAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string output = folder.file("new.voc");
  expect_refused(run_tool({"convert", folder.file("missing.txt"), output}), {"missing.txt"});
  const std::string text = public_text();
  const std::string cut = folder.write("cut.txt", text.substr(0, text.size() - 40));
  expect_refused(run_tool({"convert", cut, output}), {"cut.txt", "line 13"});
  const std::string good = folder.write("good.txt", text);
  ASSERT_EQ(run_tool({"convert", good, folder.file("good.voc")}).exit_code, 0);
  const std::string bytes = TemporaryFolder::content(folder.file("good.voc"));
  const std::string short_file = folder.write("short.voc", bytes.substr(0, bytes.size() / 2));
  expect_refused(run_tool({"info", short_file}), {"short.voc"});
  expect_refused(run_tool({"convert", good, folder.file("no/such/folder.voc")}), {"no/such"});
  expect_refused(run_tool({"train", output, folder.file("nowhere")}), {"nowhere"});
  folder.write("pictures/broken.png", "not a picture");
  const ProgramResult unusable = run_tool({"train", output, folder.file("pictures"), "--quiet"});
  EXPECT_EQ(unusable.exit_code, 2);
  EXPECT_THAT(unusable.err, HasSubstr("broken.png"));
  EXPECT_THAT(unusable.err, HasSubstr("none of the 1 pictures"));
  EXPECT_FALSE(fs::exists(output));
}

TEST(VocabularyTool, AnUnreadablePictureIsLeftOutAndNamed) {
  const OfficeSequence office;
  office.folder().write("office/" + office.colour(0), "not a picture");
  const ProgramResult result =
      run_tool({"train", office.folder().file("office.voc"), office.path(), "--every", "6", "--levels", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr(office.colour(0)));
  EXPECT_THAT(result.out, HasSubstr("pictures    1\n"));
}

TEST(VocabularyTool, HelpShowsEveryCommand) {
  const ProgramResult help = run_tool({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* const command : {"train", "convert", "info", "Examples:"})
    EXPECT_THAT(help.out, HasSubstr(command));
  EXPECT_NE(run_tool({}).exit_code, 0);
}

}  // namespace
}  // namespace cpslam
