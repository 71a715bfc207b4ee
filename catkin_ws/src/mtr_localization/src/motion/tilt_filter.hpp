/// @file
/// Tilt of base_link from gyro, accelerometer and wheels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "samples.hpp"

namespace mtr_localization {

/// Complementary filter: gyro rates in the short term, gravity in the long term. Gravity is the accelerometer reading
/// without the robot's own acceleration from wheels and gyro.
class TiltFilter {
 public:
  /// Advances by a duration with IMU and wheel speed at its end.
  /// @param standing true while the robot is stationary
  void advance(double duration_s, const ImuSample& imu, double speed_mps, bool standing);

  /// Rise of base_link's x and y axes per metre; zero without an accelerometer that shows gravity.
  const Eigen::Vector2d& slope() const { return slope_; }

 private:
  void measure_bias(double duration_s, const Eigen::Vector2d& rise_rate);

  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
  /// Bias of the slope rates.
  Eigen::Vector2d bias_ = Eigen::Vector2d::Zero();
  double bias_time_s_ = 0.0;
  /// Time since gravity was last observed.
  double blow_s_ = 0.0;
  double speed_mps_ = 0.0;
  bool is_known_ = false;
};

}  // namespace mtr_localization
