/// @file
/// Parameters of dead reckoning: how far each sensor is trusted, SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_localization {

/// Sigmas are 1 standard deviation; densities are per square root of time, distance or angle.
struct Parameters {
  /// Gyro, white noise density: 0.007 deg/s/sqrt(Hz), data sheet of the BMI270. Another gyro has another; 1.75e-4 for
  /// the MPU-9250.
  double gyro_noise_radps_per_sqrt_hz = 1.25e-4;
  /// Gyro, random walk of the bias: 8e-5 rad/s (17 deg/h) after 100 s, usual in that class.
  double gyro_bias_walk_radps_per_sqrt_s = 8e-6;
  /// Gyro, error of scale after it was compared with full turns against a mark; 0.005 by data sheet when it was not.
  double gyro_scale_sigma = 0.001;
  /// Wheel radius as mounted and inflated against its nominal value.
  double wheel_scale_sigma = 0.005;
  /// Slip along the path: 1 mm after 1 m. In simulation, without joints and gravel, 0.3 mm; not measured on asphalt.
  double slip_m_per_sqrt_m = 0.001;
  /// Shift of base_link while a skid-steered base turns about a point that is not base_link: 6 mm after 1 rad, 6 cm
  /// after a test with 90 rad. In simulation a quarter turn on the spot shifts it by 1 cm, and of a whole test's
  /// turns, which cancel in part, this much remains; see docs/accuracy.md.
  double turn_slip_m_per_sqrt_rad = 0.006;
  /// Wheels slower than this, in m/s and rad/s, may stand still.
  double standstill_linear_mps = 0.005;
  double standstill_angular_radps = 0.01;
  /// Bias-corrected gyro rate above which the robot does not stand still.
  double standstill_gyro_radps = 0.03;
  /// Wheels must rest for so long before the robot is taken to stand still: mast and tyres swing after a stop.
  double standstill_settling_s = 0.5;
  /// Duration of standstill that measures the gyro's bias before the first valid pose.
  double bias_time_s = 1.0;
  /// A longer gap in wheel odometry or IMU data is an interruption.
  double gap_limit_s = 0.2;
};

using Row = mtr_core::ParameterRow<Parameters>;

/// Range and unit of each parameter.
inline constexpr std::array<Row, 12> kRows{{
    {"gyro_noise_radps_per_sqrt_hz", &Parameters::gyro_noise_radps_per_sqrt_hz, 1e-6, 0.1, "rad/s/sqrt(Hz)"},
    {"gyro_bias_walk_radps_per_sqrt_s", &Parameters::gyro_bias_walk_radps_per_sqrt_s, 1e-8, 0.01, "rad/s/sqrt(s)"},
    {"gyro_scale_sigma", &Parameters::gyro_scale_sigma, 0.0, 0.1, "of the rate"},
    {"wheel_scale_sigma", &Parameters::wheel_scale_sigma, 0.0, 0.1, "of the distance"},
    {"slip_m_per_sqrt_m", &Parameters::slip_m_per_sqrt_m, 0.0, 0.5, "m/sqrt(m)"},
    {"turn_slip_m_per_sqrt_rad", &Parameters::turn_slip_m_per_sqrt_rad, 0.0, 0.5, "m/sqrt(rad)"},
    {"standstill_linear_mps", &Parameters::standstill_linear_mps, 0.0001, 0.05, "m/s"},
    {"standstill_angular_radps", &Parameters::standstill_angular_radps, 0.0001, 0.1, "rad/s"},
    {"standstill_gyro_radps", &Parameters::standstill_gyro_radps, 0.001, 0.2, "rad/s"},
    {"standstill_settling_s", &Parameters::standstill_settling_s, 0.1, 5.0, "s"},
    {"bias_time_s", &Parameters::bias_time_s, 0.2, 60.0, "s"},
    {"gap_limit_s", &Parameters::gap_limit_s, 0.05, 1.0, "s"},
}};

/// Throws ConfigurationError unless each value is in its range.
void check(const Parameters& parameters);

}  // namespace mtr_localization
