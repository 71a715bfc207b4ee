/// @file
/// Ground behind a robot without a rear LiDAR.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene.hpp"

namespace mtr_drive_control {
namespace {

TEST(UnwatchedRear, GroundNeverSeenIsNotBackedInto) {
  TestRobot robot(false);
  robot.settle();
  const Decision decision = robot.drive({-0.5, 0.0}, 1.0);
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.text,
            "Blocked: ground behind was not seen free lately; drive the robot ahead for half a metre with the manual "
            "controller, then turn it once on the spot.");
}

TEST(UnwatchedRear, ThingBehindThatWasNeverSeenIsNotTouchedInATurn) {
  for (const bool by_hand : {false, true}) {
    for (const double gap_m : {0.02, 0.05, 0.08}) {
      for (const Velocity& wanted :
           {Velocity{0.0, 1.0}, Velocity{0.0, -0.6}, Velocity{0.1, 1.0}, Velocity{0.02, -0.8}, Velocity{-0.001, 1.0},
            Velocity{-0.001, -1.0}, Velocity{-0.05, 0.6}, Velocity{-0.1, -0.8}}) {
        TestRobot robot(false);
        robot.scene.walls = {{{-0.254 - gap_m, -3.0}, {-0.254 - gap_m, 3.0}}};
        robot.settle();
        robot.drive(wanted, 3.0, by_hand);
        EXPECT_GT(robot.clearance(), 0.0) << gap_m << " " << wanted.linear_mps << " " << by_hand;
      }
    }
  }
}

TEST(UnwatchedRear, RobotSetsOffAheadThoughItsHeadingIsCorrected) {
  for (const double turn_radps : {0.01, -0.03, 0.06}) {
    TestRobot robot(false);
    robot.settle();
    double turn = turn_radps;
    for (int tick = 0; tick < 200; ++tick) {
      turn = tick % 10 == 0 ? -turn : turn;
      ASSERT_NE(robot.step({0.4, turn}).zone, Zone::kBlocked) << tick;
    }
    EXPECT_NEAR(robot.velocity.linear_mps, 0.4, 0.01) << turn_radps;
  }
}

TEST(UnwatchedRear, ThingBehindIsNotTouchedByManyShortTurns) {
  for (const double gap_m : {0.015, 0.03, 0.05}) {
    TestRobot robot(false);
    robot.scene.walls = {{{-0.254 - gap_m, -3.0}, {-0.254 - gap_m, 3.0}}};
    robot.settle();
    for (int turn = 0; turn < 60; ++turn) {
      robot.drive({0.0, 0.5}, 0.3);
      robot.drive({0.0, 0.0}, 1.0);
      robot.drive({0.03, 0.3}, 0.3);
      robot.drive({0.0, 0.0}, 1.0);
    }
    EXPECT_GT(robot.clearance(), 0.0) << gap_m;
  }
}

TEST(UnwatchedRear, GroundIsForgottenWhileAnEmergencyStopIsEngaged) {
  for (const bool is_emergency : {true, false}) {
    TestRobot robot(false);
    robot.settle();
    robot.drive({0.5, 0.0}, 4.0);
    robot.locks = {{"somebody", mtr_core::problem_with_text("Stop."), is_emergency}};
    robot.drive({0.0, 0.0}, 1.0);
    robot.locks.clear();
    const double back_mps = robot.drive({-0.3, 0.0}, 1.0).velocity.linear_mps;
    EXPECT_EQ(back_mps == 0.0, is_emergency);
  }
}

TEST(UnwatchedRear, SentenceOfUnseenGroundTellsAWayThatWorks) {
  for (const bool by_hand : {false, true}) {
    TestRobot robot(false);
    robot.settle();
    ASSERT_EQ(robot.drive({0.0, 0.6}, 1.0, by_hand).velocity.angular_radps, 0.0);
    robot.drive({0.4, 0.0}, 1.5, true);
    robot.drive({0.0, 0.0}, 1.5, true);
    robot.drive({0.0, 0.6}, 10.5, true);
    robot.drive({0.0, 0.0}, 1.0, true);
    EXPECT_GT(robot.drive({0.0, 0.6}, 2.0, by_hand).velocity.angular_radps, 0.5);
    robot.drive({0.0, 0.0}, 1.0);
    EXPECT_NEAR(robot.drive({-0.3, 0.0}, 1.5).velocity.linear_mps, -0.3, 1e-9);
  }
}

TEST(UnwatchedRear, RobotThatHasTurnedOnceOnTheSpotBacksAgain) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  robot.drive({0.0, 0.0}, 25.0);
  ASSERT_EQ(robot.drive({-0.5, 0.0}, 1.0).velocity.linear_mps, 0.0);
  robot.drive({0.0, 0.6}, 10.5, true);
  robot.drive({0.0, 0.0}, 1.0);
  EXPECT_NEAR(robot.drive({-0.5, 0.0}, 2.0).velocity.linear_mps, -0.3, 1e-9);
}

TEST(UnwatchedRear, OwnTrackIsBackedIntoSlowlyUntilItEnds) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 5.0);
  robot.drive({0.0, 0.0}, 1.0);
  EXPECT_NEAR(robot.drive({-0.8, 0.0}, 2.0).velocity.linear_mps, -0.3, 1e-9);
  EXPECT_EQ(robot.drive({-0.8, 0.0}, 12.0).velocity.linear_mps, 0.0);
  EXPECT_NEAR(robot.world_from_base.position().x_m, 0.0, 0.15);
}

TEST(UnwatchedRear, GroundSeenTooLongAgoIsNotBackedInto) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  robot.drive({0.0, 0.0}, 25.0);
  EXPECT_EQ(robot.drive({-0.5, 0.0}, 1.0).velocity.linear_mps, 0.0);
}

TEST(UnwatchedRear, PersonWhoWalkedOutOfViewBehindStopsBacking) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  const double behind_x = robot.world_from_base.position().x_m - 1.0;
  for (double y = 3.0; y > 0.8; y -= 0.03) {
    robot.scene.discs = {{{behind_x, y}, 0.1}};
    robot.step({0.0, 0.0});
  }
  robot.scene.discs.clear();
  robot.scene.discs = {{{behind_x, 0.0}, 0.1}};
  EXPECT_EQ(robot.drive({-0.3, 0.0}, 1.0).velocity.linear_mps, 0.0);
}

TEST(UnwatchedRear, ThingThatVanishesBehindTheCarBesideTheRobotDoesNotStopBacking) {
  TestRobot robot(false);
  robot.settle();
  robot.drive({0.5, 0.0}, 4.0);
  const double x = robot.world_from_base.position().x_m;
  robot.scene.discs = {{{x + 0.2, 1.7}, 0.1}};
  robot.drive({0.0, 0.0}, 0.2);
  robot.scene.walls = {{{x - 1.0, 1.2}, {x + 2.0, 1.2}}};
  EXPECT_NEAR(robot.drive({-0.3, 0.0}, 1.5).velocity.linear_mps, -0.3, 1e-9);
}

TEST(UnwatchedRear, PersonAtTheManualControllerMayBackSlowly) {
  TestRobot robot(false);
  robot.settle();
  EXPECT_NEAR(robot.drive({-0.5, 0.0}, 1.0, true).velocity.linear_mps, -0.3, 1e-9);
}

}  // namespace
}  // namespace mtr_drive_control
