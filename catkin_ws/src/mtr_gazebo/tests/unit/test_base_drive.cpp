/// @file
/// Controller of the base: limits, and stop without commands.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base_drive.hpp"

using mtr_gazebo::BaseDrive;
using mtr_gazebo::BaseFigures;
using mtr_gazebo::WheelSpeeds;

namespace {

constexpr BaseFigures kFigures{2.0, 4.0, 2.5, 6.0, 0.25, 0.1, 0.3};
constexpr double kStepS = 0.001;

WheelSpeeds after(BaseDrive& drive, double seconds) {
  WheelSpeeds speeds;
  for (int step = 0; step < std::lround(seconds / kStepS); ++step) {
    speeds = drive.step(kStepS);
  }
  return speeds;
}

TEST(BaseDrive, StandsUntilItIsCommanded) {
  BaseDrive drive(kFigures);
  const WheelSpeeds speeds = after(drive, 1.0);
  EXPECT_EQ(speeds.left_radps, 0.0);
  EXPECT_EQ(speeds.right_radps, 0.0);
}

TEST(BaseDrive, AcceleratesAsHardAsItMay) {
  BaseDrive drive(kFigures);
  drive.command(1.0, 0.0);
  EXPECT_NEAR(after(drive, 0.2).left_radps, 0.2 * 2.5 / 0.1, 1e-6);
}

TEST(BaseDrive, TurnsItsSidesUnlike) {
  BaseDrive drive(kFigures);
  drive.command(0.1, 0.5);
  const WheelSpeeds speeds = after(drive, 0.2);
  EXPECT_NEAR(speeds.left_radps, (0.1 - 0.5 * 0.3) / 0.1, 1e-6);
  EXPECT_NEAR(speeds.right_radps, (0.1 + 0.5 * 0.3) / 0.1, 1e-6);
}

TEST(BaseDrive, LimitsTheCommand) {
  BaseDrive drive(kFigures);
  for (int tick = 0; tick < 50; ++tick) {
    drive.command(9.0, 0.0);
    after(drive, 0.02);
  }
  EXPECT_NEAR(drive.step(kStepS).left_radps, 2.0 / 0.1, 1e-6);
}

TEST(BaseDrive, BrakesWhenNoCommandComesAnyMore) {
  BaseDrive drive(kFigures);
  drive.command(0.5, 0.0);
  EXPECT_NEAR(after(drive, 0.25).left_radps, 5.0, 1e-6);
  EXPECT_NEAR(after(drive, 0.1).left_radps, 2.5, 0.05);
  EXPECT_NEAR(after(drive, 0.2).left_radps, 0.0, 1e-9);
}

TEST(BaseDrive, IgnoresACommandThatIsNoNumber) {
  BaseDrive drive(kFigures);
  drive.command(std::numeric_limits<double>::quiet_NaN(), 0.0);
  drive.command(0.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(after(drive, 0.1).left_radps, 0.0);
}

}  // namespace
