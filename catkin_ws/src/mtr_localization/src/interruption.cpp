/// @file
/// Gaps and jumps between two wheel samples.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/interruption.hpp"

#include <cmath>
#include <cstdio>

namespace mtr_localization {
namespace {

// Faster than any base of this class: such an odometry was reset, not driven.
constexpr double kFastestWheelsMps = 3.0;
// Of its noise, however short the interval is.
constexpr double kJitterM = 0.01;

double seconds(std::int64_t duration_ns) { return static_cast<double>(duration_ns) * 1e-9; }

std::string with_number(const char* format, double number) {
  char text[120];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

}  // namespace

std::string interruption_between(const WheelSample& last, const WheelSample& wheels, const YawRateHistory& gyro,
                                 std::int64_t gap_limit_ns) {
  const std::int64_t wheel_gap_ns = wheels.stamp_ns - last.stamp_ns;
  if (wheel_gap_ns > gap_limit_ns) {
    return with_number("Wheel odometry was silent for %.2f s.", seconds(wheel_gap_ns));
  }
  const std::int64_t imu_gap_ns = gyro.longest_gap_ns(last.stamp_ns, wheels.stamp_ns);
  if (imu_gap_ns > gap_limit_ns) {
    return with_number("The IMU was silent for %.2f s.", seconds(imu_gap_ns));
  }
  const double distance_m = std::hypot(wheels.x_m - last.x_m, wheels.y_m - last.y_m);
  if (distance_m > kFastestWheelsMps * seconds(wheel_gap_ns) + kJitterM) {
    return with_number("Wheel odometry jumped by %.2f m.", distance_m);
  }
  return "";
}

}  // namespace mtr_localization
