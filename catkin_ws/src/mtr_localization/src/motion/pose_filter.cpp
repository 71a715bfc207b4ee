/// @file
/// Prediction with wheels and gyro; corrections at standstill and by scans.
// SPDX-License-Identifier: Apache-2.0
#include "motion/pose_filter.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "mtr_core/sensor_figures.hpp"

namespace mtr_localization {
namespace {

double square(double value) { return value * value; }

}  // namespace

double worst_sigma_m(const Eigen::Matrix2d& covariance) {
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

PoseFilter::PoseFilter(const SensorParameters& parameters) : parameters_(parameters) {
  covariance_(kBias, kBias) = square(mtr_core::sensor_figures::kAssumedGyroBiasAtStartRadps);
  covariance_(kWheelScale, kWheelScale) = square(parameters.wheel_scale_sigma);
  covariance_(kGyroScale, kGyroScale) = square(parameters.gyro_scale_sigma);
}

Eigen::Vector3d PoseFilter::step_of(const Motion& motion) const {
  const double angle = (1.0 + state_[kGyroScale]) * (motion.gyro_angle_rad - state_[kBias] * motion.duration_s);
  const double distance = (1.0 + state_[kWheelScale]) * motion.distance_m;
  return {distance * std::cos(0.5 * angle), distance * std::sin(0.5 * angle), angle};
}

void PoseFilter::move(const Motion& motion) {
  const double wheel_scale = 1.0 + state_[kWheelScale];
  const double gyro_scale = 1.0 + state_[kGyroScale];
  const double shown_angle = motion.gyro_angle_rad - state_[kBias] * motion.duration_s;
  const double angle = gyro_scale * shown_angle;
  const double distance = wheel_scale * motion.distance_m;
  const double direction = state_[kHeading] + 0.5 * angle;
  const double dx = distance * std::cos(direction);
  const double dy = distance * std::sin(direction);

  Eigen::Matrix<double, 1, kStates> angle_by_state = Eigen::Matrix<double, 1, kStates>::Zero();
  angle_by_state[kBias] = -gyro_scale * motion.duration_s;
  angle_by_state[kGyroScale] = shown_angle;
  Eigen::Matrix<double, 1, kStates> direction_by_state = 0.5 * angle_by_state;
  direction_by_state[kHeading] = 1.0;
  Covariance next_by_state = Covariance::Identity();
  next_by_state.row(kX) += -dy * direction_by_state;
  next_by_state.row(kY) += dx * direction_by_state;
  next_by_state.row(kHeading) += angle_by_state;
  next_by_state(kX, kWheelScale) += motion.distance_m * std::cos(direction);
  next_by_state(kY, kWheelScale) += motion.distance_m * std::sin(direction);

  state_[kX] += dx;
  state_[kY] += dy;
  state_[kHeading] = std::remainder(state_[kHeading] + angle, 2.0 * M_PI);
  covariance_ = (next_by_state * covariance_ * next_by_state.transpose()).eval();
  covariance_(kHeading, kHeading) += square(parameters_.gyro_noise_radps_per_sqrt_hz) * motion.duration_s;
  covariance_(kBias, kBias) += square(parameters_.gyro_bias_walk_radps_per_sqrt_s) * motion.duration_s;
  by_source_ = (next_by_state * by_source_).eval();
  add_motion_noise(distance, angle, direction);
}

void PoseFilter::add_motion_noise(double distance_m, double angle_rad, double direction_rad) {
  const double along = square(parameters_.slip_m_per_sqrt_m) * std::abs(distance_m);
  const double turning = square(parameters_.turn_slip_m_per_sqrt_rad) * std::abs(angle_rad);
  const double cos = std::cos(direction_rad);
  const double sin = std::sin(direction_rad);
  covariance_(kX, kX) += along * cos * cos + turning;
  covariance_(kY, kY) += along * sin * sin + turning;
  covariance_(kX, kY) += along * cos * sin;
  covariance_(kY, kX) += along * cos * sin;
}

void PoseFilter::stand(double duration_s, double gyro_rate_radps) {
  covariance_(kBias, kBias) += square(parameters_.gyro_bias_walk_radps_per_sqrt_s) * duration_s;
  const double noise = square(parameters_.gyro_noise_radps_per_sqrt_hz) / duration_s;
  const State column = covariance_.col(kBias);
  const State gain = column / (column[kBias] + noise);
  state_ += gain * (gyro_rate_radps - state_[kBias]);
  covariance_ -= gain * column.transpose();
  by_source_ -= (gain * by_source_.row(kBias)).eval();
  state_[kHeading] = std::remainder(state_[kHeading], 2.0 * M_PI);
}

void PoseFilter::correct(const PoseCorrection& correction) {
  // With P the pose covariance and H the information, this computes (inv(P) + H) without inverses of either. P is
  // singular at the start, and H is singular if the scan does not constrain a direction.
  const Eigen::Matrix3d pose_covariance = prior_covariance();
  const Eigen::Matrix3d weight = (Eigen::Matrix3d::Identity() + correction.information * pose_covariance).inverse();
  const Eigen::Matrix<double, kStates, 3> gain = covariance_.leftCols<3>() * weight;
  state_ += gain * correction.information_vector;
  state_[kHeading] = std::remainder(state_[kHeading], 2.0 * M_PI);
  if (by_source_.cols() > 0) {
    by_source_ -= (gain * correction.information * by_source_.topRows<3>()).eval();
    if (correction.vector_by_source.cols() > 0) {
      by_source_ += gain * correction.vector_by_source;
    }
  }
  covariance_ -= (gain * correction.information * covariance_.topRows<3>()).eval();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

void PoseFilter::set_pose(const Eigen::Vector3d& pose, const Eigen::Matrix3d& covariance) {
  state_.head<3>() = pose;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  covariance_.topLeftCorner<3, 3>() = covariance;
  by_source_.setZero();
}

void PoseFilter::consider_sources(int count) { by_source_ = decltype(by_source_)::Zero(kStates, count); }

Eigen::Vector3d PoseFilter::pose() const { return {x_m(), y_m(), heading_rad()}; }

double PoseFilter::heading_rad() const { return state_[kHeading] == -M_PI ? M_PI : state_[kHeading]; }

double PoseFilter::gyro_bias_sigma_radps() const { return std::sqrt(covariance_(kBias, kBias)); }

double PoseFilter::corrected_rate(double gyro_rate_radps) const {
  return (1.0 + state_[kGyroScale]) * (gyro_rate_radps - state_[kBias]);
}

double PoseFilter::corrected_speed(double wheel_speed_mps) const {
  return (1.0 + state_[kWheelScale]) * wheel_speed_mps;
}

Eigen::Matrix3d PoseFilter::pose_covariance() const {
  const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, kMaxErrorSources> lasting = by_source_.topRows<3>();
  return prior_covariance() + lasting * lasting.transpose();
}

double PoseFilter::position_sigma_m() const { return worst_sigma_m(pose_covariance().topLeftCorner<2, 2>()); }

}  // namespace mtr_localization
