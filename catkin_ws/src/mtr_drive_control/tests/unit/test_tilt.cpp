/// @file
/// Direction of gravity by the IMU, and drives on slopes (H14).
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mtr_drive_control/tilt.hpp"
#include "scene.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kDegree = kTestPi / 180.0;
constexpr double kGravity = 9.81;
constexpr double kStepS = 0.02;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A body that pitches, rolls and accelerates, and its IMU.
class GravityEstimateTest : public ::testing::Test {
 protected:
  /// Moves for a while; largest tilt that is estimated meanwhile, in deg.
  double move(double duration_s, double acceleration_mps2 = 0.0, double pitch_rate_radps = 0.0) {
    double largest_deg = 0.0;
    for (int tick = 0; tick < std::lround(duration_s / kStepS); ++tick) {
      now_ns += kTestPeriodNs;
      pitch_rad += pitch_rate_radps * kStepS;
      speed_mps += acceleration_mps2 * kStepS;
      const double noise = noise_mps2 * std::sin(7919.0 * static_cast<double>(now_ns / kTestMs));
      estimate.take({now_ns,
                     {bias_radps, pitch_rate_radps - bias_radps, yaw_rate_radps},
                     {acceleration_mps2 - kGravity * std::sin(pitch_rad) + noise, speed_mps * yaw_rate_radps - noise,
                      kGravity * std::cos(pitch_rad) + noise}},
                    wheels_show_it ? std::optional<Velocity>({speed_mps, yaw_rate_radps}) : std::nullopt);
      largest_deg = std::max(largest_deg, tilt_deg());
    }
    return largest_deg;
  }

  double tilt_deg() const { return estimate.tilt_at(now_ns).value_or(kNan) / kDegree; }

  std::int64_t now_ns = 5'000'000'000;
  double pitch_rad = 0.0;
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double bias_radps = 0.0;
  double noise_mps2 = 0.0;
  bool wheels_show_it = true;
  GravityEstimate estimate;
};

TEST_F(GravityEstimateTest, LevelRobotIsLevelFromItsFirstReading) {
  move(kStepS);
  EXPECT_NEAR(tilt_deg(), 0.0, 1e-9);
}

TEST_F(GravityEstimateTest, SlopeOfTheStartIsKnownFromTheFirstReading) {
  for (const double pitch_deg : {-40.0, -4.0, 2.0, 5.0, 30.0}) {
    estimate = GravityEstimate();
    pitch_rad = pitch_deg * kDegree;
    move(kStepS);
    EXPECT_NEAR(tilt_deg(), std::abs(pitch_deg), 1e-6);
  }
}

TEST_F(GravityEstimateTest, NothingIsKnownWithoutAReading) { EXPECT_FALSE(estimate.tilt_at(now_ns)); }

TEST_F(GravityEstimateTest, BrakingThatTheWheelsShowIsNoTilt) {
  move(2.0);
  double largest_deg = move(0.7, 1.0);
  largest_deg = std::max(largest_deg, move(0.3, -2.4));
  EXPECT_LT(largest_deg, 0.2);
}

TEST_F(GravityEstimateTest, BrakingThatNoWheelShowsStaysBelowTheTiltAtWhichTheRobotSlows) {
  wheels_show_it = false;
  move(3.0);
  double largest_deg = move(0.86, 1.0);
  largest_deg = std::max(largest_deg, move(0.36, -2.4));
  EXPECT_LT(largest_deg, 2.0);
}

TEST_F(GravityEstimateTest, StartsAndStopsInARowDoNotAddUp) {
  for (const bool shown : {true, false}) {
    wheels_show_it = shown;
    move(3.0);
    for (int leg = 0; leg < 20; ++leg) {
      EXPECT_LT(move(0.7, 1.0), 2.0);
      EXPECT_LT(move(0.3, -0.7 / 0.3), 2.0);
    }
  }
}

TEST_F(GravityEstimateTest, CurveIsNoTilt) {
  move(1.0);
  move(0.7, 1.0);
  yaw_rate_radps = 1.4;
  EXPECT_LT(move(10.0), 0.1);
}

TEST_F(GravityEstimateTest, RampIsSeenWithinAThirdOfASecond) {
  move(5.0);
  move(0.4, 0.0, 5.0 * kDegree / 0.4);
  move(0.3);
  EXPECT_GT(tilt_deg(), 4.0);
  move(2.0);
  EXPECT_NEAR(tilt_deg(), 5.0, 0.1);
}

TEST_F(GravityEstimateTest, RampIsKeptForMinutes) {
  move(5.0);
  move(0.4, 0.0, 5.0 * kDegree / 0.4);
  move(120.0);
  EXPECT_NEAR(tilt_deg(), 5.0, 0.05);
}

TEST_F(GravityEstimateTest, WheelThatRollsOverACableIsASmallTilt) {
  move(5.0);
  double largest_deg = move(0.1, 0.0, 3.3 * kDegree / 0.1);
  largest_deg = std::max(largest_deg, move(0.1, 0.0, -3.3 * kDegree / 0.1));
  EXPECT_LT(largest_deg, 2.0);
}

TEST_F(GravityEstimateTest, BiasOfTheGyroIsLearnedAtRest) {
  for (const double bias_deg : {0.2, -1.0, 2.9}) {
    estimate = GravityEstimate();
    bias_radps = bias_deg * kDegree;
    speed_mps = 0.0;
    EXPECT_LT(move(3.0), 2.0);
    EXPECT_LT(move(0.7, 1.0), 0.5);
    EXPECT_LT(move(60.0), 0.5) << bias_deg;
  }
}

TEST_F(GravityEstimateTest, BiasThatWandersInMotionStaysSmall) {
  move(3.0);
  move(0.5, 1.0);
  bias_radps = 0.2 * kDegree;
  EXPECT_LT(move(60.0), 1.0);
}

TEST_F(GravityEstimateTest, NoiseOfTheAccelerometerIsNoTilt) {
  noise_mps2 = 1.0;
  move(1.0);
  EXPECT_LT(move(20.0), 2.0);
}

TEST_F(GravityEstimateTest, WhatShowsNoGravityIsUnknownAfterHalfASecondAndSoIsSilence) {
  const std::array<double, 3> shown{0.0, 0.0, kGravity};
  for (const std::array<double, 3>& wrong : {std::array<double, 3>{0.0, 0.0, 0.0},
                                             {0.0, 0.0, 1.0},
                                             {0.0, 0.0, 0.5 * kGravity},
                                             {0.0, 0.0, 2.0 * kGravity},
                                             {kNan, 0.0, kGravity},
                                             {0.0, 0.0, kNan},
                                             {0.0, 0.0, std::numeric_limits<double>::infinity()}}) {
    estimate = GravityEstimate();
    estimate.take({now_ns, {}, shown}, std::nullopt);
    ASSERT_TRUE(estimate.tilt_at(now_ns));
    for (int tick = 1; tick <= 30; ++tick) {
      estimate.take({now_ns + tick * kTestPeriodNs, {}, wrong}, std::nullopt);
      EXPECT_EQ(estimate.tilt_at(now_ns + tick * kTestPeriodNs).has_value(), tick <= 25) << wrong[2] << " " << tick;
    }
    estimate.take({now_ns + 31 * kTestPeriodNs, {}, shown}, std::nullopt);
    EXPECT_TRUE(estimate.tilt_at(now_ns + 31 * kTestPeriodNs));
  }
  EXPECT_FALSE(estimate.tilt_at(now_ns + 60 * kTestPeriodNs));
}

TEST_F(GravityEstimateTest, GravityThatWasNeverSeenIsUnknown) {
  for (int tick = 1; tick <= 100; ++tick) {
    estimate.take({now_ns + tick * kTestPeriodNs, {0.01, 0.0, 0.0}, {0.0, 0.0, 0.0}}, std::nullopt);
    EXPECT_FALSE(estimate.tilt_at(now_ns + tick * kTestPeriodNs));
  }
}

TEST_F(GravityEstimateTest, PauseAndClockThatGoesBackBeginAgainWithWhatIsMeasured) {
  move(5.0);
  for (const std::int64_t gap_ns : {std::int64_t{2'000'000'000}, std::int64_t{-3'000'000'000}}) {
    now_ns += gap_ns;
    pitch_rad = pitch_rad == 0.0 ? 6.0 * kDegree : 0.0;
    move(2.0 * kStepS);
    EXPECT_NEAR(tilt_deg(), pitch_rad / kDegree, 0.1);
  }
}

TEST_F(GravityEstimateTest, UpsideDownIsTheLargestTilt) {
  pitch_rad = kTestPi;
  move(1.0);
  EXPECT_NEAR(tilt_deg(), 180.0, 1e-6);
}

TEST_F(GravityEstimateTest, JumpOfTheOdometryIsNoTilt) {
  move(3.0);
  const double kept_mps = speed_mps;
  speed_mps += 3.0;
  EXPECT_LT(move(kStepS), 2.0);
  speed_mps = kept_mps;
  EXPECT_LT(move(3.0), 2.0);
}

class SlopeTest : public ::testing::Test {
 protected:
  SlopeTest() { robot.settle(); }

  /// Puts the robot on such ground: after a pause the estimate begins with what is measured.
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
