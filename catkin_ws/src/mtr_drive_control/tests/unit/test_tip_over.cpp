/// @file
/// Limits by the height of the key.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {
namespace {

TEST(TipOver, RaisedKeyLowersTheEmergencyDecelerationToItsShareOfTheStaticLimit) {
  const Parameters parameters;
  const double centre_m = parameters.centre_of_mass_m + parameters.centre_of_mass_rise * 1.55;
  const double static_limit = 9.81 * parameters.tip_lever_along_m / centre_m;
  EXPECT_NEAR(limits_at(parameters, 1.55).emergency_linear_deceleration_mps2, parameters.tip_margin * static_limit,
              1e-9);
}

TEST(TipOver, FlatRobotKeepsTheParametersAsTheyAre) {
  Parameters flat;
  flat.centre_of_mass_m = 0.1;
  EXPECT_DOUBLE_EQ(limits_at(flat, 0.35).emergency_linear_deceleration_mps2, 3.0);
  EXPECT_DOUBLE_EQ(limits_at(flat, 0.35).max_linear_mps, 1.0);
}

TEST(TipOver, LowerKeyAllowsAQuickerStop) {
  EXPECT_GT(limits_at(Parameters{}, 0.35).emergency_linear_deceleration_mps2,
            limits_at(Parameters{}, 1.55).emergency_linear_deceleration_mps2 + 0.2);
}

TEST(TipOver, UnknownOrImpossibleHeightCountsAsRaised) {
  const double raised = limits_at(Parameters{}, 1.55).emergency_linear_deceleration_mps2;
  for (const double height_m : {std::nan(""), -1.0, 7.0}) {
    EXPECT_DOUBLE_EQ(limits_at(Parameters{}, height_m).emergency_linear_deceleration_mps2, raised);
  }
}

TEST(TipOver, StopFromTheHighestPermittedSpeedEndsInTimeAtEveryHeight) {
  for (double height_m = 0.0; height_m < 1.6; height_m += 0.1) {
    const Parameters limits = limits_at(Parameters{}, height_m);
    EXPECT_LE(limits.max_linear_mps / limits.emergency_linear_deceleration_mps2, kStopWithinS + 1e-9);
  }
}

TEST(TipOver, StopFromEveryPermittedVelocityInACurveEndsInTimeToo) {
  const Limits limits = limits_at(Parameters{}, 1.55);
  for (double linear = -2.0; linear <= 2.0; linear += 0.1) {
    for (double angular = -4.0; angular <= 4.0; angular += 0.2) {
      const Velocity desired{linear, angular};
      EXPECT_LE(limits.stop_time_s(desired.scaled(limits.permitted_share(desired))), kStopWithinS + 1e-9);
    }
  }
}

TEST(TipOver, StopInACurveIsGentlerByItsCurvatureWhateverTheSpeed) {
  const Limits limits = limits_at(Parameters{}, 1.55);
  const double straight = limits.emergency_deceleration_mps2({0.7, 0.0});
  EXPECT_DOUBLE_EQ(straight, limits.emergency_linear_deceleration_mps2);
  EXPECT_NEAR(limits.emergency_deceleration_mps2({0.4, 0.8}), straight / (1.0 + 2.0 * limits.curve_lever_m), 1e-9);
  EXPECT_NEAR(limits.emergency_deceleration_mps2({-0.1, 0.2}), straight / (1.0 + 2.0 * limits.curve_lever_m), 1e-9);
}

TEST(TipOver, TurnOnTheSpotIsNotSlowedByTheTippingLimits) {
  EXPECT_DOUBLE_EQ(limits_at(Parameters{}, 1.55).permitted_share({0.0, 1.5}), 1.0);
}

TEST(TipOver, UpToTheSmallTiltTheLimitsAreThoseOfLevelGround) {
  for (const double tilt_rad : {0.0, 0.01, 0.0349}) {
    for (const Row& row : kRows) {
      EXPECT_EQ(limits_at(Parameters{}, 1.55, tilt_rad).*(row.member), limits_at(Parameters{}, 1.55).*(row.member));
    }
  }
}

TEST(TipOver, SlopeBeyondTheSmallTiltIsSubtractedFromTheDeceleration) {
  const Parameters parameters;
  for (const double key_m : {0.35, 1.55}) {
    const double level = limits_at(parameters, key_m).emergency_linear_deceleration_mps2;
    for (const double tilt_rad : {0.05, 0.0698, 0.1}) {
      EXPECT_NEAR(limits_at(parameters, key_m, tilt_rad).emergency_linear_deceleration_mps2,
                  level - 9.81 * std::sin(tilt_rad - parameters.tilt_slow_rad), 1e-9);
    }
  }
}

TEST(TipOver, StopOnASlopeLoadsTheWheelsNoMoreThanOneAtTheSmallTilt) {
  // Deceleration that tips the body over its front wheels; on tyres a sudden stop counts half as much again.
  const Parameters parameters;
  const auto thrown_mps2 = [&](double tilt_rad) {
    return 1.5 * limits_at(parameters, 1.55, tilt_rad).emergency_linear_deceleration_mps2 + 9.81 * std::sin(tilt_rad);
  };
  for (double tilt_rad = 0.04; tilt_rad < 0.2; tilt_rad += 0.01) {
    EXPECT_LE(thrown_mps2(tilt_rad), thrown_mps2(parameters.tilt_slow_rad) + 1e-9);
    EXPECT_LT(thrown_mps2(tilt_rad), 0.9 * static_limit_mps2(parameters, 1.55));
  }
}

TEST(TipOver, LimitsFallWithoutAStepAndStayPositive) {
  Limits before = limits_at(Parameters{}, 1.55);
  for (double tilt_rad = 0.0; tilt_rad < 3.1; tilt_rad += 0.001) {
    const Limits limits = limits_at(Parameters{}, 1.55, tilt_rad);
    for (double Parameters::*each : {&Parameters::linear_acceleration_mps2, &Parameters::linear_deceleration_mps2,
                                     &Parameters::emergency_linear_deceleration_mps2, &Parameters::max_linear_mps,
                                     &Parameters::lateral_acceleration_mps2, &Parameters::max_angular_radps}) {
      EXPECT_LE(limits.*each, before.*each);
      EXPECT_GT(limits.*each, before.*each - 0.03);
      EXPECT_GT(limits.*each, 0.0);
    }
    EXPECT_LE(limits.max_linear_mps / limits.emergency_linear_deceleration_mps2, kStopWithinS + 1e-9);
    before = limits;
  }
}

TEST(TipOver, AtTheTiltThatStopsTheRobotItIsAsSlowAsAPersonMayDriveItOff) {
  const Parameters parameters;
  for (const double key_m : {0.35, 1.55}) {
    EXPECT_NEAR(limits_at(parameters, key_m, parameters.tilt_stop_rad).max_linear_mps, parameters.tilt_creep_mps, 1e-9);
  }
}

TEST(TipOver, TopHeavyRobotIsLimitedInEveryAcceleration) {
  Parameters parameters;
  parameters.centre_of_mass_m = 1.5;
  const Parameters limits = limits_at(parameters, 0.35);
  EXPECT_LT(limits.linear_acceleration_mps2, 0.55);
  EXPECT_DOUBLE_EQ(limits.linear_deceleration_mps2, limits.linear_acceleration_mps2);
  EXPECT_LT(limits.lateral_acceleration_mps2, 0.9);
}

}  // namespace
}  // namespace mtr_drive_control
