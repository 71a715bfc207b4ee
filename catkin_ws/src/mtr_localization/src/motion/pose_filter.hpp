/// @file
/// Extended Kalman filter of the pose with wheels and gyro as input and LiDAR scans as corrections.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "parameters.hpp"

namespace mtr_localization {

/// Motion of one interval as measured.
struct Motion {
  double duration_s;
  /// Along base_link x by the wheels, negative backwards.
  double distance_m;
  /// Integral of the gyro rate, including its bias.
  double gyro_angle_rad;
};

inline constexpr int kMaxErrorSources = 96;

/// Correction by a scan in information form, summed over its beams. With the Jacobian J and the weights W of the
/// residuals r at the prior pose, `information` is J' W J and `information_vector` is -J' W r. Both refer to x (m),
/// y (m), heading (rad). See ScanMatcher.
struct PoseCorrection {
  Eigen::Vector3d information_vector = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Change of the information vector by 1 sigma of each persistent error source; one column per source, or empty.
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxErrorSources> vector_by_source{3, 0};
};

/// Pose of base_link in map with the errors of its sensors.
///
/// State: x, y, heading, gyro bias, wheel scale error, gyro scale error. The sensor errors are states instead of noise,
/// because they persist. Their effect on the pose grows with distance and time, not with the square roots, and a bias
/// measured at standstill also corrects the heading errors that it caused before.
///
/// Errors of map surfaces persist as long as the map, so more scans do not average them out. They are considered but
/// not estimated (Schmidt filter, Jazwinski 1970, 8.4, without its change of the gain). The filter stores the effect of
/// 1 sigma of each source on its state, and adds it to the reported covariance.
class PoseFilter {
 public:
  explicit PoseFilter(const SensorParameters& parameters);

  /// Returns the change of pose by a motion, in base_link before it, corrected by the estimated sensor errors.
  Eigen::Vector3d step_of(const Motion& motion) const;

  /// Predicts over a motion.
  void move(const Motion& motion);

  /// Updates the bias with the gyro rate at standstill.
  void stand(double duration_s, double gyro_rate_radps);

  /// Corrects the present pose with a scan.
  void correct(const PoseCorrection& correction);

  /// Adds noise for a motion that neither wheels nor gyro measured.
  void add_pose_noise(const Eigen::Matrix3d& covariance) { covariance_.topLeftCorner<3, 3>() += covariance; }

  /// Sets the pose from an independent source; the sensor errors are kept.
  void set_pose(const Eigen::Vector3d& pose, const Eigen::Matrix3d& covariance);

  /// Sets the number of persistent error sources of later corrections, and forgets the previous sources.
  void consider_sources(int count);

  /// Returns x (m), y (m), heading (rad) within (-pi, pi].
  Eigen::Vector3d pose() const;
  /// Returns the pose covariance without persistent errors, as the prior of the next scan.
  Eigen::Matrix3d prior_covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  double x_m() const { return state_[kX]; }
  double y_m() const { return state_[kY]; }
  /// Heading within (-pi, pi].
  double heading_rad() const;
  double gyro_bias_radps() const { return state_[kBias]; }
  double gyro_bias_sigma_radps() const;
  /// Relative error of the wheel distance.
  double wheel_scale() const { return state_[kWheelScale]; }

  /// Returns the true turn rate for a measured one.
  double corrected_rate(double gyro_rate_radps) const;
  /// Returns the true speed for a measured one.
  double corrected_speed(double wheel_speed_mps) const;

  /// Returns the covariance of x (m), y (m), heading (rad) with persistent errors.
  Eigen::Matrix3d pose_covariance() const;
  /// Returns 1 sigma of the position in its worst direction.
  double position_sigma_m() const;

 private:
  enum Index { kX, kY, kHeading, kBias, kWheelScale, kGyroScale, kStates };
  using State = Eigen::Matrix<double, kStates, 1>;
  using Covariance = Eigen::Matrix<double, kStates, kStates>;

  void add_motion_noise(double distance_m, double angle_rad, double direction_rad);

  SensorParameters parameters_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  Eigen::Matrix<double, kStates, Eigen::Dynamic, 0, kStates, kMaxErrorSources> by_source_{kStates, 0};
};

/// Returns 1 sigma of a position in its worst direction.
double worst_sigma_m(const Eigen::Matrix2d& covariance);

}  // namespace mtr_localization
