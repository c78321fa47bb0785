#include "detect/hysteresis_detector.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <utility>

#include "detect/box_overlap.h"

namespace cpslam {
namespace {

using Boxes = std::vector<PersonBox>;

/// Gives the boxes that were put down for a stamp.
class ScriptedDetector : public PersonDetector {
 public:
  explicit ScriptedDetector(std::map<double, Boxes> script) : script_(std::move(script)) {}
  std::vector<PersonBox> detect(const cv::Mat& /*colour*/, double time_s) override {
    return script_.at(time_s);
  }
  [[nodiscard]] std::string name() const override { return "script"; }

 private:
  std::map<double, Boxes> script_;
};

PersonBox box(double x, double confidence) {
  return {x, 50.0, 100.0, 200.0, confidence};
}

/// The confidences of what is left for each stamp, with 0.6 asked of somebody new.
std::vector<std::vector<double>> left(const std::map<double, Boxes>& script) {
  HysteresisDetector detector(std::make_unique<ScriptedDetector>(script), 0.6);
  std::vector<std::vector<double>> all;
  for (const auto& entry : script) {
    std::vector<double>& confidences = all.emplace_back();
    for (const PersonBox& found : detector.detect(cv::Mat(), entry.first))
      confidences.push_back(found.confidence);
  }
  return all;
}

using Left = std::vector<std::vector<double>>;

TEST(HysteresisDetector, WeakBoxesStayWhereTheyGoOn) {
  EXPECT_EQ(left({{1.0, {box(0.0, 0.5)}},
                  {1.1, {box(5.0, 0.6)}},
                  {1.2, {box(20.0, 0.4)}},
                  {1.3, {box(40.0, 0.3)}},
                  {1.4, {box(60.0, 0.3), box(400.0, 0.5)}}}),
            (Left{{}, {0.6}, {0.4}, {0.3}, {0.3}}));
}

TEST(HysteresisDetector, WhoIsAwayTooLongIsNewAgain) {
  EXPECT_EQ(left({{1.0, {box(0.0, 0.9)}}, {1.1, {}}, {1.25, {box(0.0, 0.4)}}, {1.6, {box(0.0, 0.4)}}}),
            (Left{{0.9}, {}, {0.4}, {}}));
}

TEST(HysteresisDetector, OneBoxGoesOnInOneBoxAndTheSurestComesFirst) {
  EXPECT_EQ(left({{1.0, {box(0.0, 0.9)}}, {1.1, {box(2.0, 0.4), box(10.0, 0.5)}}}), (Left{{0.9}, {0.5}}));
  EXPECT_EQ(left({{1.0, {box(0.0, 0.9), box(30.0, 0.8)}}, {1.1, {box(0.0, 0.4), box(29.0, 0.5)}}}),
            (Left{{0.9, 0.8}, {0.5, 0.4}}));
}

TEST(HysteresisDetector, NothingGoesOnFromWhatIsLaterOrElsewhere) {
  HysteresisDetector detector(std::make_unique<ScriptedDetector>(std::map<double, Boxes>{
                                  {5.0, {box(0.0, 0.9)}}, {4.9, {box(0.0, 0.4)}}, {5.1, {box(40.0, 0.4)}}}),
                              0.6);
  EXPECT_EQ(detector.detect(cv::Mat(), 5.0).size(), 1U);
  EXPECT_TRUE(detector.detect(cv::Mat(), 5.1).empty()) << "an overlap of 6 to 14";
  EXPECT_TRUE(detector.detect(cv::Mat(), 4.9).empty());
  EXPECT_EQ(detector.name(), "script");
}

TEST(HysteresisDetector, AFailurePassesThroughAndForgetsNobody) {
  HysteresisDetector detector(std::make_unique<ScriptedDetector>(
                                  std::map<double, Boxes>{{5.0, {box(0.0, 0.9)}}, {5.2, {box(0.0, 0.4)}}}),
                              0.6);
  EXPECT_EQ(detector.detect(cv::Mat(), 5.0).size(), 1U);
  EXPECT_THROW((void)detector.detect(cv::Mat(), 5.1), std::out_of_range);
  EXPECT_EQ(detector.detect(cv::Mat(), 5.2).size(), 1U);
}

TEST(BoxOverlap, IsIntersectionOverUnion) {
  EXPECT_FLOAT_EQ(box_overlap({0.0, 0.0, 4.0, 2.0, 1.0}, {2.0, 1.0, 4.0, 2.0, 1.0}), 2.0F / 14.0F);
  EXPECT_FLOAT_EQ(box_overlap({0.0, 0.0, 4.0, 2.0, 1.0}, {0.0, 0.0, 4.0, 2.0, 0.5}), 1.0F);
  EXPECT_EQ(box_overlap({0.0, 0.0, 4.0, 2.0, 1.0}, {4.0, 0.0, 4.0, 2.0, 1.0}), 0.0F);
  EXPECT_EQ(box_overlap({0.0, 0.0, 4.0, 2.0, 1.0}, {1.0, 1.0, -1.0, 2.0, 1.0}), 0.0F);
}

}  // namespace
}  // namespace cpslam
