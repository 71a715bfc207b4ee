/// @file
/// Errors of the IMU have the specified size, and are reproducible for a seed.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/imu_errors.hpp"

using mtr_gazebo::ImuErrors;
using mtr_gazebo::ImuFigures;
using mtr_gazebo::ImuReading;

namespace {

constexpr double kPeriodS = 0.01;

TEST(ImuErrors, WithoutErrorsItSaysTheTruthButForTheScale) {
  ImuFigures figures;
  figures.gyro_scale_error = 0.01;
  ImuErrors errors(figures, kPeriodS, 1);
  const ImuReading reading = errors.read({{0.1, -0.2, 1.0}, {0.0, 0.5, 9.81}});
  EXPECT_DOUBLE_EQ(reading.rate[2], 1.01);
  EXPECT_DOUBLE_EQ(reading.force[1], 0.5);
  EXPECT_DOUBLE_EQ(reading.force[2], 9.81);
}

TEST(ImuErrors, WhiteNoiseIsItsDensityByTheRootOfThePeriod) {
  ImuFigures figures;
  figures.gyro_density = 1e-3;
  ImuErrors errors(figures, kPeriodS, 7);
  double square = 0.0;
  constexpr int kReadings = 20000;
  for (int reading = 0; reading < kReadings; ++reading) {
    square += std::pow(errors.read({}).rate[2], 2);
  }
  EXPECT_NEAR(std::sqrt(square / kReadings), 1e-3 / std::sqrt(kPeriodS), 2e-4);
}

TEST(ImuErrors, ABiasStaysAndOneThatWandersGrowsWithTheRootOfTime) {
  ImuFigures still;
  still.accelerometer_bias_mps2 = 0.05;
  ImuErrors errors(still, kPeriodS, 3);
  EXPECT_EQ(errors.read({}).force[0], errors.read({}).force[0]);

  double square = 0.0;
  constexpr int kSeeds = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    ImuFigures walking;
    walking.gyro_bias_walk = 1e-3;
    ImuErrors wandering(walking, kPeriodS, static_cast<std::uint64_t>(seed));
    ImuReading last;
    for (int step = 0; step < 100; ++step) {
      last = wandering.read({});
    }
    square += std::pow(last.rate[0], 2);
  }
  // 1 s: one standard deviation of the walk.
  EXPECT_NEAR(std::sqrt(square / kSeeds), 1e-3, 1.5e-4);
}

TEST(ImuErrors, TheSameSeedGivesTheSameErrors) {
  const ImuFigures figures{1e-3, 1e-2, 1e-5, 0.0, 1e-2, 0.05, 1e-4};
  ImuErrors first(figures, kPeriodS, 5);
  ImuErrors second(figures, kPeriodS, 5);
  ImuErrors other(figures, kPeriodS, 6);
  const double value = first.read({}).rate[0];
  EXPECT_EQ(value, second.read({}).rate[0]);
  EXPECT_NE(value, other.read({}).rate[0]);
}

}  // namespace
