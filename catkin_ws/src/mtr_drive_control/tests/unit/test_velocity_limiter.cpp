/// @file
/// Limits on speed and acceleration.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mtr_drive_control/velocity_limiter.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kPeriodS = 0.02;

class VelocityLimiterTest : public ::testing::Test {
 protected:
  Velocity follow_for(const Velocity& wanted, double duration_s) {
    Velocity sent;
    for (int tick = 0; tick < std::lround(duration_s / kPeriodS); ++tick) {
      sent = follow(wanted);
    }
    return sent;
  }

  Velocity follow(const Velocity& wanted) {
    limiter.send(limiter.toward(wanted));
    return limiter.sent();
  }

  Velocity stop() {
    limiter.send(limiter.braked());
    return limiter.sent();
  }

  const Limits limits{Parameters{}};
  VelocityLimiter limiter{limits, kPeriodS};
};

TEST_F(VelocityLimiterTest, FirstStepIsBoundedByTheAccelerations) {
  const Velocity sent = follow({1.0, 0.9});
  EXPECT_NEAR(sent.linear_mps, 0.02, 1e-12);
  EXPECT_NEAR(sent.angular_radps, 0.04, 1e-12);
}

TEST_F(VelocityLimiterTest, SmallDesiredVelocityIsReachedExactly) {
  const Velocity sent = follow_for({0.5, -0.3}, 1.0);
  EXPECT_DOUBLE_EQ(sent.linear_mps, 0.5);
  EXPECT_DOUBLE_EQ(sent.angular_radps, -0.3);
}

TEST_F(VelocityLimiterTest, TooFastDesiredVelocityKeepsItsCurvature) {
  const Velocity sent = follow_for({6.0, 0.8}, 3.0);
  EXPECT_NEAR(sent.linear_mps, 1.0, 1e-9);
  EXPECT_NEAR(sent.angular_radps / sent.linear_mps, 0.8 / 6.0, 1e-9);
}

TEST_F(VelocityLimiterTest, FastCurveIsSlowedUntilAStopInItEndsInTime) {
  const Velocity sent = follow_for({1.5, 1.5}, 3.0);
  EXPECT_NEAR(limits.stop_time_s(sent), kStopWithinS, 1e-9);
  EXPECT_NEAR(sent.linear_mps, sent.angular_radps, 1e-9);
}

TEST_F(VelocityLimiterTest, FastCurveIsSlowedToTheLateralLimit) {
  Parameters parameters;
  parameters.lateral_acceleration_mps2 = 0.3;
  limiter = VelocityLimiter(Limits(parameters), kPeriodS);
  const Velocity sent = follow_for({1.5, 1.5}, 3.0);
  EXPECT_NEAR(sent.linear_mps * sent.angular_radps, 0.3, 1e-9);
  EXPECT_NEAR(sent.linear_mps, sent.angular_radps, 1e-9);
}

TEST_F(VelocityLimiterTest, TurningInAtFullSpeedLeavesAStopInTimeAtEveryTick) {
  follow_for({1.0, 0.0}, 2.0);
  Velocity sent;
  for (int tick = 0; tick < 100; ++tick) {
    sent = follow({0.2, 1.5});
    EXPECT_LE(std::abs(sent.linear_mps * sent.angular_radps), 1.0 + 1e-12);
    EXPECT_LE(limits.stop_time_s(sent), kStopWithinS + 1e-12);
  }
  EXPECT_DOUBLE_EQ(sent.angular_radps, 1.5);
}

TEST_F(VelocityLimiterTest, ReversalBrakesToZeroBeforeItAccelerates) {
  double last = follow_for({0.5, 0.0}, 1.0).linear_mps;
  bool stood = false;
  for (int tick = 0; tick < 100; ++tick) {
    const double now = follow({-0.5, 0.0}).linear_mps;
    stood = stood || now == 0.0;
    EXPECT_LE(std::abs(now - last), (now < 0.0 ? 1.0 : 1.5) * kPeriodS + 1e-12);
    EXPECT_TRUE(now >= 0.0 || stood);
    last = now;
  }
  EXPECT_DOUBLE_EQ(last, -0.5);
}

TEST_F(VelocityLimiterTest, InfiniteMagnitudesOfDoubleAreNotFinite) {
  EXPECT_FALSE((Velocity{std::numeric_limits<double>::infinity(), 0.0}).is_finite());
  EXPECT_FALSE((Velocity{0.0, std::numeric_limits<double>::quiet_NaN()}).is_finite());
  EXPECT_TRUE((Velocity{0.0, 1.0}).is_finite());
}

TEST_F(VelocityLimiterTest, EmergencyStopFromFullSpeedReachesZeroWithinHalfASecond) {
  follow_for({1.0, 0.0}, 2.0);
  Velocity sent;
  for (int tick = 0; tick < 25; ++tick) {
    const double before = tick == 0 ? 1.0 : sent.linear_mps;
    sent = stop();
    EXPECT_LE(before - sent.linear_mps, 3.0 * kPeriodS * 1.01);
  }
  EXPECT_EQ(sent.linear_mps, 0.0);
}

TEST_F(VelocityLimiterTest, EmergencyStopKeepsTheCurve) {
  const Velocity before = follow_for({0.8, 0.9}, 2.0);
  const Velocity sent = stop();
  EXPECT_LT(sent.linear_mps, before.linear_mps);
  EXPECT_NEAR(sent.angular_radps / sent.linear_mps, before.angular_radps / before.linear_mps, 1e-9);
}

TEST_F(VelocityLimiterTest, EmergencyStopAtRestStaysAtRest) {
  const Velocity sent = stop();
  EXPECT_EQ(sent.linear_mps, 0.0);
  EXPECT_EQ(sent.angular_radps, 0.0);
}

TEST_F(VelocityLimiterTest, DesiredVelocityAfterAnEmergencyStopStartsFromTheVelocitySentLast) {
  follow_for({1.0, 0.0}, 2.0);
  const double stopped_to = stop().linear_mps;
  EXPECT_NEAR(follow({1.0, 0.0}).linear_mps, stopped_to + 0.02, 1e-9);
}

}  // namespace
}  // namespace mtr_drive_control
