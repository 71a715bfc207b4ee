/// @file
/// Odometry counts whole ticks without losses.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/wheel_odometry.hpp"

using mtr_gazebo::OdometryReading;
using mtr_gazebo::WheelOdometry;

namespace {

TEST(WheelOdometry, SaysTheWayStraightOn) {
  WheelOdometry odometry({0.1, 0.3, 78000.0});
  const OdometryReading reading = odometry.read(5.0, 5.0, 0.5);
  EXPECT_NEAR(reading.x_m, 0.5, 2e-5);
  EXPECT_NEAR(reading.linear_mps, 1.0, 4e-5);
  EXPECT_EQ(reading.heading_rad, 0.0);
}

TEST(WheelOdometry, SaysATurnOnTheSpot) {
  WheelOdometry odometry({0.1, 0.3, 78000.0});
  const OdometryReading reading = odometry.read(-3.0, 3.0, 1.0);
  EXPECT_NEAR(reading.heading_rad, 1.0, 1e-4);
  EXPECT_NEAR(reading.angular_radps, 1.0, 1e-4);
  EXPECT_NEAR(reading.x_m, 0.0, 1e-4);
}

TEST(WheelOdometry, FollowsAnArc) {
  WheelOdometry odometry({0.1, 0.3, 1e6});
  OdometryReading reading;
  for (int step = 1; step <= 1000; ++step) {
    // Radius 1 m, a quarter of a circle.
    const double angle = M_PI_2 * step / 1000.0;
    reading = odometry.read(angle * (1.0 - 0.3) / 0.1, angle * (1.0 + 0.3) / 0.1, 0.02);
  }
  EXPECT_NEAR(reading.x_m, 1.0, 1e-4);
  EXPECT_NEAR(reading.y_m, 1.0, 1e-4);
  EXPECT_NEAR(reading.heading_rad, M_PI_2, 1e-4);
}

TEST(WheelOdometry, CountsWholeTicksAndLosesNone) {
  // A tick is 10 mm; 4 mm per reading.
  WheelOdometry odometry({0.1, 0.3, 100.0});
  EXPECT_EQ(odometry.read(0.04, 0.04, 0.02).linear_mps, 0.0);
  EXPECT_EQ(odometry.read(0.08, 0.08, 0.02).linear_mps, 0.0);
  EXPECT_NEAR(odometry.read(0.12, 0.12, 0.02).linear_mps, 0.5, 1e-9);
  EXPECT_NEAR(odometry.read(1.005, 1.005, 0.02).x_m, 0.10, 1e-9);
}

}  // namespace
