/// @file
/// Uncertainty of a growing map: a heading error displaces the whole path after it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "mapping/map_drift.hpp"

namespace mtr_localization {
namespace {

constexpr double kStepM = 0.01;
constexpr double kStepS = 0.02;

/// Returns the position sigma along the worse axis.
double position_sigma_m(const MapDrift& drift) {
  return std::sqrt(drift.covariance().topLeftCorner<2, 2>().eigenvalues().real().maxCoeff());
}

MapDrift straight(const Parameters& parameters, double length_m) {
  MapDrift drift(parameters);
  for (int step = 0; step < std::lround(length_m / kStepM); ++step) {
    drift.travel({kStepS, kStepM, 0.0}, 0.5);
  }
  return drift;
}

TEST(MapDrift, AcrossAStraightPathItGrowsWithTheHeadingErrorOfAllOfIt) {
  Parameters parameters;
  parameters.sensors.gyro_noise_radps_per_sqrt_hz = 1e-6;
  for (const double length_m : {10.0, 30.0, 100.0}) {
    const MapDrift drift = straight(parameters, length_m);
    const double position = std::pow(parameters.mapping.mapping_drift_m_per_sqrt_m, 2) * length_m;
    const double heading = std::pow(parameters.mapping.mapping_drift_rad_per_sqrt_m, 2);
    EXPECT_NEAR(drift.covariance()(2, 2), heading * length_m, 1e-6 * length_m);
    // Integral of the random walk of the heading over the path.
    EXPECT_NEAR(position_sigma_m(drift), std::sqrt(position + heading * std::pow(length_m, 3) / 3.0),
                0.02 * length_m * std::sqrt(heading * length_m));
  }
}

TEST(MapDrift, BackAtItsStartARoundTripIsLessUncertainThanAtItsFarEnd) {
  const Parameters parameters;
  MapDrift drift(parameters);
  double farthest_m = 0.0;
  // Circle of 6 m round the Car.
  for (int step = 0; step < std::lround(2.0 * M_PI * 6.0 / kStepM); ++step) {
    drift.travel({kStepS, kStepM, kStepM / 6.0}, step * kStepM / 6.0);
    farthest_m = std::max(farthest_m, position_sigma_m(drift));
  }
  EXPECT_GT(farthest_m, 0.06);
  EXPECT_LT(farthest_m, 0.25);
}

TEST(MapDrift, TurnRateOfWheelsInsteadOfAGyroMakesTheHeadingUncertain) {
  Parameters parameters;
  parameters.sensors.gyro_noise_radps_per_sqrt_hz = 0.017;
  const MapDrift drift = straight(parameters, 100.0);
  EXPECT_GT(std::sqrt(drift.covariance()(2, 2)), 0.2);
}

TEST(MapDrift, StandingAddsNothingAndARestartForgetsAll) {
  const Parameters parameters;
  MapDrift drift = straight(parameters, 5.0);
  drift.restart();
  EXPECT_TRUE(drift.covariance().isZero(0.0));
}

}  // namespace
}  // namespace mtr_localization
