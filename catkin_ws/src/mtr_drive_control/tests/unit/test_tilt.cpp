/// @file
/// Direction of gravity from the IMU (H14).
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

/// Body that pitches, rolls and accelerates, and its IMU.
class GravityEstimateTest : public ::testing::Test {
 protected:
  /// Moves for some time; returns the largest estimated tilt meanwhile, in deg.
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

}  // namespace
}  // namespace mtr_drive_control
