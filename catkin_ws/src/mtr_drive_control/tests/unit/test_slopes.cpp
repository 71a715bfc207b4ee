/// @file
/// Drives on slopes (H14).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "mtr_drive_control/tip_over.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kDegree = kTestPi / 180.0;
constexpr double kGravity = 9.81;
constexpr double kStepS = 0.02;

class SlopeTest : public ::testing::Test {
 protected:
  SlopeTest() { robot.settle(); }

  /// Puts the robot on this slope: after a pause the estimate starts from the measurement.
  void tilt(double degrees) {
    robot.pitch_rad = degrees * kDegree;
    robot.now_ns += 500 * kTestMs;
    robot.wheels = {};
    robot.drive({}, 0.2);
  }

  Decision drive(double speed_mps, bool by_hand = false) { return robot.drive({speed_mps, 0.0}, 1.5, by_hand); }

  TestRobot robot;
};

TEST_F(SlopeTest, BelowTwoDegreesNothingChanges) {
  const double level_mps = drive(1.5).velocity.linear_mps;
  EXPECT_DOUBLE_EQ(level_mps, limits_at(Parameters{}, 0.35).max_linear_mps);
  tilt(1.9);
  const Decision decision = drive(1.5);
  EXPECT_DOUBLE_EQ(decision.velocity.linear_mps, level_mps);
  EXPECT_EQ(decision.zone, Zone::kClear);
}

TEST_F(SlopeTest, SpeedFallsEvenlyFromTwoToFourDegrees) {
  double before_mps = drive(1.5).velocity.linear_mps;
  for (const double degrees : {2.5, 3.0, 3.5, 3.9}) {
    tilt(degrees);
    const double speed_mps = drive(1.5).velocity.linear_mps;
    EXPECT_LT(speed_mps, before_mps - 0.1);
    EXPECT_NEAR(speed_mps, 0.858 - (degrees - 2.0) / 2.0 * (0.858 - 0.15), 0.02);
    before_mps = speed_mps;
  }
}

TEST_F(SlopeTest, FromFourDegreesThePlannerIsStoppedWithASentenceAndSlopesBothWaysAndAsideCount) {
  for (const double degrees : {4.1, -4.1, 10.0}) {
    tilt(0.0);
    ASSERT_GT(drive(0.5).velocity.linear_mps, 0.1);
    tilt(degrees);
    const Decision decision = drive(0.5);
    EXPECT_EQ(decision.velocity.linear_mps, 0.0) << degrees;
    EXPECT_EQ(decision.message.code, "drive_control.tilted");
    EXPECT_EQ(decision.zone, Zone::kBlocked);
    EXPECT_EQ(decision.source, "planner");
  }
  tilt(0.0);
  robot.spoil_imu = [](ImuReading& imu) { imu.forces_mps2[1] = 9.81 * std::sin(4.2 * kDegree); };
  tilt(0.0);
  EXPECT_EQ(drive(0.5).message.code, "drive_control.tilted");
}

TEST_F(SlopeTest, SlopeNearTheLimitIsOneStopAndLevelGroundEndsIt) {
  tilt(4.1);
  ASSERT_EQ(drive(0.5).message.code, "drive_control.tilted");
  tilt(3.3);
  EXPECT_EQ(drive(0.5).message.code, "drive_control.tilted");
  tilt(2.8);
  EXPECT_GT(drive(0.5).velocity.linear_mps, 0.1);
}

TEST_F(SlopeTest, StopOnASlopeTakesTheReducedDeceleration) {
  const Parameters parameters;
  const double level_mps2 = limits_at(parameters, 1.55).emergency_linear_deceleration_mps2;
  robot.key_height_m = 1.55;
  tilt(3.5);
  drive(0.3);
  robot.locks = {{"state_machine", {"state_machine.test", "A test locks it.", {}, {}}}};
  const double before_mps = robot.velocity.linear_mps;
  ASSERT_GT(before_mps, 0.25);
  const double step_mps = before_mps - robot.step({0.3, 0.0}).velocity.linear_mps;
  EXPECT_NEAR(step_mps, (level_mps2 - kGravity * std::sin(1.5 * kDegree)) * kStepS, 1e-3);
}

TEST_F(SlopeTest, PersonDrivesOffSlowlyAndReadsWhy) {
  for (const double key_m : {0.35, 1.55}) {
    robot.key_height_m = key_m;
    for (const double degrees : {4.5, 8.0}) {
      tilt(degrees);
      for (const double wanted_mps : {0.75, -0.75}) {
        const Decision decision = drive(wanted_mps, true);
        EXPECT_NEAR(decision.velocity.linear_mps, std::copysign(0.15, wanted_mps), 1e-6) << degrees;
        EXPECT_EQ(decision.message.code, "drive_control.tilted");
        EXPECT_EQ(decision.source, "manual");
        robot.drive({}, 2.0, true);
      }
    }
  }
}

TEST_F(SlopeTest, PersonDoesNotDriveWhereAStopWouldTipTheRobot) {
  for (const auto& [key_m, degrees] : {std::pair<double, double>{1.55, 13.0}, {0.35, 15.0}, {0.35, 60.0}}) {
    robot.key_height_m = key_m;
    tilt(degrees);
    const Decision decision = drive(0.4, true);
    EXPECT_EQ(decision.velocity.linear_mps, 0.0);
    EXPECT_EQ(decision.message.code, "drive_control.tilted_too_far");
  }
}

TEST_F(SlopeTest, LoweredKeyLetsThePersonDriveASteeperSlope) {
  robot.key_height_m = 1.55;
  tilt(12.5);
  EXPECT_EQ(drive(0.4, true).velocity.linear_mps, 0.0);
  robot.key_height_m = 0.35;
  EXPECT_GT(drive(0.4, true).velocity.linear_mps, 0.1);
}

TEST_F(SlopeTest, UnknownTiltStopsPlannerAndPersonWithASentence) {
  for (const bool by_hand : {false, true}) {
    for (const double wrong : {0.0, 1.0, 30.0}) {
      robot.spoil_imu = nullptr;
      ASSERT_GT(drive(0.4, by_hand).velocity.linear_mps, 0.1);
      robot.spoil_imu = [wrong](ImuReading& imu) { imu.forces_mps2 = {1e-3 * imu.rates_radps[0], 0.0, wrong}; };
      const Decision decision = robot.drive({0.4, 0.0}, 1.0, by_hand);
      EXPECT_EQ(decision.velocity.linear_mps, 0.0) << wrong;
      EXPECT_EQ(decision.message.code, "drive_control.tilt_unknown");
      EXPECT_EQ(decision.zone, Zone::kBlind);
    }
  }
}

TEST_F(SlopeTest, RobotThatNeverHeardAnImuStands) {
  DriveControl control(Parameters{}, CollisionParameters{}, test_shape(false), kStepS);
  const auto sweep = Scene().sweep(Pose(), robot.now_ns - 40 * kTestMs);
  const SourceCommand command{robot.now_ns - kTestPeriodNs, {0.4, 0.0}, true};
  const Motion standing{robot.now_ns, Pose(), {}};
  const Decision decision =
      control.step(robot.now_ns, {{}, 0.0, command, command, {sweep, nullptr, standing}, std::nullopt, std::nullopt});
  EXPECT_EQ(decision.velocity.linear_mps, 0.0);
  EXPECT_EQ(decision.message.code, "drive_control.tilt_unknown");
}

TEST_F(SlopeTest, NodeThatStartsOnASlopeStands) {
  TestRobot anew;
  anew.pitch_rad = 5.0 * kDegree;
  EXPECT_EQ(anew.drive({0.4, 0.0}, 1.0).message.code, "drive_control.tilted");
  EXPECT_EQ(anew.velocity.linear_mps, 0.0);
}

TEST_F(SlopeTest, StopThatTheCollisionStopPlansIsLongerOnASlope) {
  robot.key_height_m = 1.55;
  const auto planned_m = [this](double degrees) {
    tilt(degrees);
    return robot.control.stopping_path_of({0.3, 0.0}).back().pose.position().x_m;
  };
  const double level_m = planned_m(0.0);
  EXPECT_DOUBLE_EQ(planned_m(1.9), level_m);
  EXPECT_GT(planned_m(3.0), level_m + 0.001);
  EXPECT_GT(planned_m(3.9), planned_m(3.0) + 0.001);
}

TEST_F(SlopeTest, WallOnASlopeIsNotTouched) {
  for (const double degrees : {0.0, 2.5, 3.8}) {
    TestRobot robot;
    robot.key_height_m = 1.55;
    robot.pitch_rad = degrees * kDegree;
    robot.scene.walls = {{{3.0, -3.0}, {3.0, 3.0}}};
    robot.settle();
    robot.drive({0.7, 0.0}, 30.0);
    EXPECT_EQ(robot.velocity.linear_mps, 0.0);
    EXPECT_GT(robot.clearance(), 0.03);
  }
}

}  // namespace
}  // namespace mtr_drive_control
