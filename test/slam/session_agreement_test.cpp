#include "slam/session_agreement.h"

#include <gtest/gtest.h>

#include "slam/session_scene.h"

namespace cpslam {
namespace {

using scene::kElsewhere;
using scene::kRig;
using scene::Sessions;

class SessionAgreementTest : public testing::Test {
 protected:
  Random random_{72};
  const synthetic::World world_ = scene::round_world(2500, random_);
  Sessions sessions_;
};

TEST_F(SessionAgreementTest, TwoOfOneRoomAgreeWhereBothHaveLooked) {
  const auto first = sessions_.add(world_, 0, 12, {});
  const auto second = sessions_.add(world_, 6, 18, kElsewhere);
  const SessionAgreement agreement =
      compare_sessions(kRig, sessions_.map, sessions_.edge(second[2], first[8]));
  EXPECT_GE(agreement.agreeing, 6);
  EXPECT_EQ(agreement.contradicting, 0);
  EXPECT_GT(agreement.span_m, 1.5);
  EXPECT_TRUE(is_enough(agreement));
}

TEST_F(SessionAgreementTest, ItDoesNotMatterWhichIsTheCurrentOne) {
  const auto first = sessions_.add(world_, 0, 12, {});
  const auto second = sessions_.add(world_, 6, 18, kElsewhere);
  EXPECT_TRUE(is_enough(compare_sessions(kRig, sessions_.map, sessions_.edge(first[8], second[2]))));
}

TEST_F(SessionAgreementTest, ALoopToTheWrongPlaceFindsNothing) {
  const auto first = sessions_.add(world_, 0, 12, {});
  const auto second = sessions_.add(world_, 6, 18, kElsewhere);
  LoopEdge wrong = sessions_.edge(second[2], first[8]);
  wrong.matched = first[3];
  const SessionAgreement agreement = compare_sessions(kRig, sessions_.map, wrong);
  EXPECT_GE(agreement.contradicting, 3);
  EXPECT_FALSE(is_enough(agreement));
}

TEST_F(SessionAgreementTest, TwinsAreToldApartByWhatIsBesideThem) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const synthetic::World twin = scene::twin_of(world_, kQuarter, 0.9, random_);
  const auto first = sessions_.add(world_, 0, 12, {});
  const auto second = sessions_.add(twin, 0, 12, kElsewhere);
  const SessionAgreement agreement =
      compare_sessions(kRig, sessions_.map, sessions_.edge(second[6], first[6]));
  EXPECT_GE(agreement.agreeing, 1) << "the twin itself";
  EXPECT_GE(agreement.contradicting, 4) << "its surroundings";
  EXPECT_FALSE(is_enough(agreement));
}

TEST_F(SessionAgreementTest, ALookAtOneThingAloneIsNotEnough) {
  const auto first = sessions_.add(world_, 0, 12, {});
  const auto second = sessions_.add(world_, 5, 8, kElsewhere);
  const SessionAgreement agreement =
      compare_sessions(kRig, sessions_.map, sessions_.edge(second[1], first[6]));
  EXPECT_GE(agreement.agreeing, 4);
  EXPECT_EQ(agreement.contradicting, 0);
  EXPECT_FALSE(is_enough(agreement)) << "it could be another one of its kind";
}

TEST_F(SessionAgreementTest, WhatIsGoneAgreesWithNothing) {
  const auto first = sessions_.add(world_, 0, 4, {});
  EXPECT_FALSE(is_enough(compare_sessions(kRig, sessions_.map, {{}, first[0], {}})));
}

}  // namespace
}  // namespace cpslam
