/// @file
/// Errors of an inertial measurement unit: scale, bias random walk, and white noise.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>

namespace mtr_gazebo {

using Triple = std::array<double, 3>;

/// Error parameters: densities per square root of Hz, random walks per square root of s.
struct ImuFigures {
  double gyro_density{0.0};
  double gyro_bias_radps{0.0};
  double gyro_bias_walk{0.0};
  double gyro_scale_error{0.0};
  double accelerometer_density{0.0};
  double accelerometer_bias_mps2{0.0};
  double accelerometer_bias_walk{0.0};
};

/// Mean angular velocity in rad/s and specific force in m/s2 over a period, in the sensor's frame.
struct ImuReading {
  Triple rate{};
  Triple force{};
};

/// Adds errors to the true means over one period.
class ImuErrors {
 public:
  ImuErrors(const ImuFigures& figures, double period_s, std::uint64_t seed);

  /// Returns the reading of the sensor for true values.
  ImuReading read(const ImuReading& truth);

 private:
  double normal();

  ImuFigures figures_;
  double period_s_;
  std::mt19937_64 random_;
  std::normal_distribution<double> distribution_;
  Triple gyro_bias_{};
  Triple accelerometer_bias_{};
};

}  // namespace mtr_gazebo
