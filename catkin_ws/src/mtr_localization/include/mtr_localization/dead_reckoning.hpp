/// @file
/// Extended Kalman filter of the pose under wheel and gyro motion.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

#include "mtr_localization/parameters.hpp"

namespace mtr_localization {

/// Motion of one interval as the sensors see it.
struct Motion {
  double duration_s;
  /// Along base_link x by the wheels, negative backwards.
  double distance_m;
  /// Integral of the gyro's rate, bias included.
  double gyro_angle_rad;
};

/// Pose of base_link in map with the errors of its sensors.
///
/// State: x, y, heading, gyro bias, wheel scale error, gyro scale error. The sensors' errors are states and not noise,
/// because they persist: what they do to the pose grows with distance and time rather than with their square roots,
/// and a bias found at standstill corrects the heading that it has spoilt on the way.
class DeadReckoning {
 public:
  explicit DeadReckoning(const Parameters& parameters);

  /// The robot moved.
  void move(const Motion& motion);

  /// The robot stood still for a time while the gyro showed this rate.
  void stand(double duration_s, double gyro_rate_radps);

  double x_m() const { return state_[kX]; }
  double y_m() const { return state_[kY]; }
  /// Within (-pi, pi].
  double heading_rad() const;
  double gyro_bias_radps() const { return state_[kBias]; }
  double gyro_bias_sigma_radps() const;

  /// True rate of turn for a rate that the gyro shows.
  double corrected_rate(double gyro_rate_radps) const;
  /// True speed for a speed that the wheels show.
  double corrected_speed(double wheel_speed_mps) const;

  /// Row-major 3x3 of x (m), y (m), heading (rad).
  std::array<double, 9> pose_covariance() const;

 private:
  enum Index { kX, kY, kHeading, kBias, kWheelScale, kGyroScale, kStates };
  using State = Eigen::Matrix<double, kStates, 1>;
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  void add_motion_noise(double distance_m, double angle_rad, double direction_rad);

  Parameters parameters_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace mtr_localization
