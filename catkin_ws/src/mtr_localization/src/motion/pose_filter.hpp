/// @file
/// Extended Kalman filter of the pose under wheel and gyro motion, corrected by what the LiDARs see.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "parameters.hpp"

namespace mtr_localization {

/// Motion of one interval as the sensors see it.
struct Motion {
  double duration_s;
  /// Along base_link x by the wheels, negative backwards.
  double distance_m;
  /// Integral of the gyro's rate, bias included.
  double gyro_angle_rad;
};

inline constexpr int kMaxErrorSources = 96;

/// What a scan says about the pose, in information form, as the sum of its beams: with the Jacobian J and the weights W
/// of the residuals r at the prior pose, `information` is J' W J and `information_vector` is -J' W r, both in x (m),
/// y (m), heading (rad). See ScanMatcher.
struct PoseCorrection {
  Eigen::Vector3d information_vector = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// Information vector by an error of 1 sigma of each lasting error source; one column per source, or no column.
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxErrorSources> vector_by_source{3, 0};
};

/// Pose of base_link in map with the errors of its sensors.
///
/// State: x, y, heading, gyro bias, wheel scale error, gyro scale error. The sensors' errors are states and not noise,
/// because they persist: what they do to the pose grows with distance and time rather than with their square roots,
/// and a bias found at standstill corrects the heading that it has spoilt on the way.
///
/// Surfaces of a map are wrong by errors that last as long as the map: no number of scans averages them out. They are
/// considered and not estimated (Schmidt's filter, Jazwinski 1970, 8.4, without its change of the gain): the filter
/// keeps what an error of 1 sigma of each source does to its state, and adds it to the covariance that it tells.
class PoseFilter {
 public:
  explicit PoseFilter(const SensorParameters& parameters);

  /// Change of pose by a motion, in base_link before it, as far as the sensors' errors are known.
  Eigen::Vector3d step_of(const Motion& motion) const;

  /// The robot moved.
  void move(const Motion& motion);

  /// The robot stood still for a time while the gyro showed this rate.
  void stand(double duration_s, double gyro_rate_radps);

  /// What a scan says about the present pose.
  void correct(const PoseCorrection& correction);

  /// The robot was moved by something that neither wheels nor gyro tell.
  void add_pose_noise(const Eigen::Matrix3d& covariance) { covariance_.topLeftCorner<3, 3>() += covariance; }

  /// The pose is known from elsewhere, independently of what was known before; the sensors' errors stay.
  void set_pose(const Eigen::Vector3d& pose, const Eigen::Matrix3d& covariance);

  /// The number of lasting error sources that later corrections speak of; forgets those before.
  void consider_sources(int count);

  /// x (m), y (m), heading (rad) within (-pi, pi].
  Eigen::Vector3d pose() const;
  /// Covariance of the pose without lasting errors: what the next scan is weighed against.
  Eigen::Matrix3d prior_covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  double x_m() const { return state_[kX]; }
  double y_m() const { return state_[kY]; }
  /// Within (-pi, pi].
  double heading_rad() const;
  double gyro_bias_radps() const { return state_[kBias]; }
  double gyro_bias_sigma_radps() const;
  /// Relative error of the wheels' distance.
  double wheel_scale() const { return state_[kWheelScale]; }

  /// True rate of turn for a rate that the gyro shows.
  double corrected_rate(double gyro_rate_radps) const;
  /// True speed for a speed that the wheels show.
  double corrected_speed(double wheel_speed_mps) const;

  /// Covariance of x (m), y (m), heading (rad), with lasting errors.
  Eigen::Matrix3d pose_covariance() const;
  /// Of the position, in its worst direction.
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

/// 1 sigma of a position in its worst direction.
double worst_sigma_m(const Eigen::Matrix2d& covariance);

}  // namespace mtr_localization
