/// @file
/// The sent velocity starts from the wheels' motion and stays close to it (A1).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "mtr_drive_control/tip_over.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPeriodS = 0.02;
constexpr Velocity kFast{0.7, 0.0};

class FollowingTheWheels : public ::testing::Test {
 protected:
  FollowingTheWheels() {
    robot.settle();
    robot.drive(kFast, 1.5);
  }

  /// Skips ticks for a duration; then the wheels have this velocity.
  void pause(double duration_s, const Velocity& wheels) {
    robot.now_ns += std::llround(duration_s * 1e9);
    robot.wheels = wheels;
  }

  const Limits limits = limits_at(Parameters{}, 0.35);
  TestRobot robot;
};

TEST_F(FollowingTheWheels, PauseInWhichTheBaseTimedOutIsFollowedByAStartFromStandstill) {
  ASSERT_DOUBLE_EQ(robot.velocity.linear_mps, 0.7);
  for (const double pause_s : {0.3, 0.6, 1.0, 2.0}) {
    pause(pause_s, {});
    EXPECT_LE(robot.step(kFast).velocity.linear_mps, limits.linear_acceleration_mps2 * kPeriodS + 1e-9);
    robot.drive(kFast, 1.5);
  }
}

TEST_F(FollowingTheWheels, PauseWhileTheWheelsGoOnIsFollowedByAStepFromTheirVelocity) {
  pause(0.1, {0.5, 0.0});
  EXPECT_NEAR(robot.step(kFast).velocity.linear_mps, 0.5, limits.emergency_linear_deceleration_mps2 * kPeriodS);
}

TEST_F(FollowingTheWheels, PauseWithoutOdometryAfterItIsFollowedByZero) {
  pause(0.1, {0.5, 0.0});
  robot.odometry_is_silent = true;
  EXPECT_EQ(robot.step(kFast).velocity.linear_mps, 0.0);
}

TEST_F(FollowingTheWheels, WheelsFasterThanPermittedAreFollowedWithinTheLimits) {
  pause(0.1, {1.9, 1.9});
  const Velocity sent = robot.step(kFast).velocity;
  EXPECT_LE(limits.stop_time_s(sent), kStopWithinS + 1e-9);
}

TEST_F(FollowingTheWheels, TwoPeriodsWithoutATickAreNoPause) {
  pause(kPeriodS, {0.65, 0.0});
  EXPECT_DOUBLE_EQ(robot.step(kFast).velocity.linear_mps, 0.7);
}

TEST_F(FollowingTheWheels, ClockThatGoesBackIsAPause) {
  pause(-3600.0, {});
  EXPECT_LE(robot.step(kFast).velocity.linear_mps, limits.linear_acceleration_mps2 * kPeriodS + 1e-9);
}

TEST_F(FollowingTheWheels, NodeThatStartsInMotionBeginsFromTheWheels) {
  TestRobot anew;
  anew.wheels = {0.5, 0.0};
  EXPECT_NEAR(anew.step({}).velocity.linear_mps, 0.5, limits.emergency_linear_deceleration_mps2 * kPeriodS + 1e-9);
}

TEST_F(FollowingTheWheels, ContradictionIsNotCountedAcrossAPause) {
  robot.obeys = false;
  robot.wheels = {};
  robot.drive(kFast, 0.3);
  pause(1.0, {});
  robot.obeys = true;
  EXPECT_EQ(robot.drive(kFast, 1.0).source, "planner");
}

class LateTicks : public ::testing::TestWithParam<std::int64_t> {
 protected:
  LateTicks() {
    robot.scene.walls = {{{6.0, -3.0}, {6.0, 3.0}}};
    robot.settle();
    robot.drive(kFast, 1.5);
    robot.period_ns = GetParam() * kTestMs;
  }

  TestRobot robot;
};

TEST_P(LateTicks, StopTakesNoLongerThanWithTicksInTime) {
  robot.drive(kFast, 0.5);
  ASSERT_GT(robot.velocity.linear_mps, 0.3);
  robot.locks = {{"state_machine", {"state_machine.test", "A test locks it.", {}, {}}}};
  robot.drive(kFast, 0.5);
  EXPECT_EQ(robot.velocity.linear_mps, 0.0);
}

TEST_P(LateTicks, WallIsNotTouched) {
  robot.drive(kFast, 15.0);
  EXPECT_EQ(robot.velocity.linear_mps, 0.0);
  EXPECT_GT(robot.clearance(), 0.03);
}

INSTANTIATE_TEST_SUITE_P(MsApart, LateTicks, ::testing::Values(30, 40, 60, 80));

TEST(BaseThatStands, IsNotSentMoreThanTheLead) {
  TestRobot robot;
  robot.obeys = false;
  robot.settle();
  const Limits limits = limits_at(Parameters{}, 0.35);
  for (int tick = 0; tick < 200; ++tick) {
    const Velocity sent = robot.step({0.7, 0.5}).velocity;
    EXPECT_LE(sent.linear_mps, limits.max_lead_mps + limits.linear_acceleration_mps2 * kPeriodS + 1e-9);
    EXPECT_LE(sent.angular_radps, limits.max_lead_radps + limits.angular_acceleration_radps2 * kPeriodS + 1e-9);
  }
}

TEST(BaseThatTurnsTooSlowly, IsNotSentMoreThanTheLead) {
  TestRobot robot;
  robot.obeys = false;
  robot.settle();
  const Limits limits = limits_at(Parameters{}, 0.35);
  for (int tick = 0; tick < 200; ++tick) {
    EXPECT_GE(robot.step({0.0, -1.5}).velocity.angular_radps,
              -limits.max_lead_radps - limits.angular_acceleration_radps2 * kPeriodS - 1e-9);
  }
}

}  // namespace
}  // namespace mtr_drive_control
