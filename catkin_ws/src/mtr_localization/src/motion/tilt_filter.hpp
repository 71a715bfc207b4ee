/// @file
/// How far base_link leans, from gyro, accelerometer and wheels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "samples.hpp"

namespace mtr_localization {

/// Complementary filter: the gyro's rates for the moment, gravity in the long run. Gravity is what the accelerometer
/// shows without what wheels and gyro say of the robot's own acceleration.
class TiltFilter {
 public:
  /// The robot went on for a time: IMU and wheel speed at its end. @param standing it stands still
  void advance(double duration_s, const ImuSample& imu, double speed_mps, bool standing);

  /// Rise of base_link's x and y axes per metre; zero as long as no accelerometer shows gravity.
  const Eigen::Vector2d& slope() const { return slope_; }

 private:
  void measure_bias(double duration_s, const Eigen::Vector2d& rise_rate);

  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
  /// Bias of the slope's rates.
  Eigen::Vector2d bias_ = Eigen::Vector2d::Zero();
  double bias_time_s_ = 0.0;
  /// Gravity has not been seen for so long.
  double blow_s_ = 0.0;
  double speed_mps_ = 0.0;
  bool is_known_ = false;
};

}  // namespace mtr_localization
