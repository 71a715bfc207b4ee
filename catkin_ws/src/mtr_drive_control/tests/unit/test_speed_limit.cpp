/// @file
/// The Command's maximum speed limits the planner.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "mtr_core/steady_time.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

/// Drives for one second with this limit, which has this age at each tick.
Decision drive_limited(TestRobot& robot, const Velocity& desired, double max_mps, std::int64_t age_ns = 0,
                       bool by_hand = false) {
  Decision decision;
  for (int tick = 0; tick < 50; ++tick) {
    robot.speed_limit = SpeedLimit{robot.now_ns + kTestPeriodNs - age_ns, max_mps};
    decision = robot.step(desired, by_hand);
  }
  return decision;
}

TEST(SpeedLimitOfTheCommand, HoldsInBothDirectionsAndOnTheSameCircle) {
  for (const double sign : {1.0, -1.0}) {
    TestRobot robot;
    robot.settle();
    const Decision decision = drive_limited(robot, {0.6 * sign, 0.4}, 0.3);
    EXPECT_NEAR(decision.velocity.linear_mps, 0.3 * sign, 1e-9);
    EXPECT_NEAR(decision.velocity.angular_radps, 0.2, 1e-9);
  }
}

TEST(SpeedLimitOfTheCommand, LeavesSlowerMotionAndTurnsOnTheSpot) {
  TestRobot robot;
  robot.settle();
  EXPECT_DOUBLE_EQ(drive_limited(robot, {0.3, 0.0}, 0.3).velocity.linear_mps, 0.3);
  robot.drive({0.0, 0.0}, 1.0);
  EXPECT_DOUBLE_EQ(drive_limited(robot, {0.0, 0.8}, 0.01).velocity.angular_radps, 0.8);
}

TEST(SpeedLimitOfTheCommand, BrakesGentlyWhenItIsLowered) {
  TestRobot robot;
  robot.settle();
  drive_limited(robot, {0.8, 0.0}, 0.8);
  robot.speed_limit = SpeedLimit{robot.now_ns, 0.2};
  const double before_mps = robot.velocity.linear_mps;
  const double after_mps = robot.step({0.8, 0.0}).velocity.linear_mps;
  EXPECT_LT(after_mps, before_mps);
  EXPECT_GT(after_mps, before_mps - 0.035);
  EXPECT_NEAR(drive_limited(robot, {0.8, 0.0}, 0.2).velocity.linear_mps, 0.2, 1e-9);
}

TEST(SpeedLimitOfTheCommand, ThatIsNoPositiveNumberPermitsNoMotion) {
  for (const double max_mps : {0.0, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
    TestRobot robot;
    robot.settle();
    EXPECT_TRUE(drive_limited(robot, {0.5, 0.5}, max_mps).velocity.is_zero()) << max_mps;
  }
}

TEST(SpeedLimitOfTheCommand, ThatIsMissingOrSilentStopsTheRobotAndSaysSo) {
  TestRobot robot;
  robot.settle();
  const Decision fresh = drive_limited(robot, {0.5, 0.0}, 0.8, 240 * kTestMs);
  EXPECT_DOUBLE_EQ(fresh.velocity.linear_mps, 0.5);
  const Decision silent = drive_limited(robot, {0.5, 0.0}, 0.8, 270 * kTestMs);
  EXPECT_TRUE(silent.velocity.is_zero());
  EXPECT_EQ(silent.message.text, "The state machine is silent.");
  robot.speed_limit = SpeedLimit{mtr_core::kNeverNs, 0.0};
  const Decision missing = robot.step({0.5, 0.0});
  EXPECT_TRUE(missing.velocity.is_zero());
  EXPECT_EQ(missing.message.text, "Waiting for the state machine.");
}

TEST(SpeedLimitOfTheCommand, IsNoneForAPersonWithTheManualController) {
  TestRobot robot;
  robot.settle();
  EXPECT_DOUBLE_EQ(drive_limited(robot, {0.5, 0.0}, 0.1, 0, true).velocity.linear_mps, 0.5);
  EXPECT_DOUBLE_EQ(drive_limited(robot, {0.5, 0.0}, 0.1, 1'000 * kTestMs, true).velocity.linear_mps, 0.5);
}

}  // namespace
}  // namespace mtr_drive_control
