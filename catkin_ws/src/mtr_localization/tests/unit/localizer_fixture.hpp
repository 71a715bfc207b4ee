/// @file
/// Drive with ideal sensors, for tests of the localizer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "localizer.hpp"

namespace mtr_localization {

constexpr std::int64_t kStepNs = 20'000'000;
constexpr double kStepS = 0.02;

/// Simulates a robot with a gyro bias and feeds the localizer with 50 samples per second.
class LocalizerFixture : public ::testing::Test {
 protected:
  /// Drives for a time at constant velocity; returns the newest estimate.
  Estimate drive(double linear_mps, double angular_radps, double duration_s) {
    for (int step = 0; step < std::lround(duration_s / kStepS); ++step) {
      step_once(linear_mps, angular_radps);
    }
    return newest;
  }

  void step_once(double linear_mps, double angular_radps) {
    advance_truth(linear_mps, angular_radps);
    send_imu();
    send_wheels();
  }

  void advance_truth(double linear_mps, double angular_radps) {
    const double direction = wheels.heading_rad + 0.5 * angular_radps * kStepS;
    wheels.x_m += linear_mps * kStepS * std::cos(direction);
    wheels.y_m += linear_mps * kStepS * std::sin(direction);
    wheels.heading_rad += angular_radps * kStepS;
    wheels.linear_mps = linear_mps;
    wheels.angular_radps = angular_radps;
    wheels.stamp_ns += kStepNs;
  }

  void send_imu() { take(localizer.add_imu({wheels.stamp_ns, wheels.angular_radps + gyro_bias_radps})); }
  void send_wheels() { take(localizer.add_wheels(wheels)); }

  void take(const std::vector<Estimate>& estimates) {
    for (const Estimate& estimate : estimates) {
      newest = estimate;
      ++estimates_received;
    }
  }

  Localizer localizer{Parameters{}};
  WheelSample wheels{1'000'000'000, 0.0, 0.0, 0.0, 0.0, 0.0};
  double gyro_bias_radps = 0.01;
  Estimate newest;
  int estimates_received = 0;
};

}  // namespace mtr_localization
