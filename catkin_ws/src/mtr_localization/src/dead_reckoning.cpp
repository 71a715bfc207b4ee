/// @file
/// Prediction by wheels and gyro, correction by standing still.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/dead_reckoning.hpp"

#include <cmath>

namespace mtr_localization {
namespace {

// Bias of an uncalibrated MEMS gyro at switch-on by data sheet, 1 sigma: about 3 deg/s.
constexpr double kFirstBiasSigmaRadps = 0.05;

double square(double value) { return value * value; }

}  // namespace

DeadReckoning::DeadReckoning(const Parameters& parameters) : parameters_(parameters) {
  covariance_(kBias, kBias) = square(kFirstBiasSigmaRadps);
  covariance_(kWheelScale, kWheelScale) = square(parameters.wheel_scale_sigma);
  covariance_(kGyroScale, kGyroScale) = square(parameters.gyro_scale_sigma);
}

void DeadReckoning::move(const Motion& motion) {
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
  add_motion_noise(distance, angle, direction);
}

void DeadReckoning::add_motion_noise(double distance_m, double angle_rad, double direction_rad) {
  const double along = square(parameters_.slip_m_per_sqrt_m) * std::abs(distance_m);
  const double turning = square(parameters_.turn_slip_m_per_sqrt_rad) * std::abs(angle_rad);
  const double cos = std::cos(direction_rad);
  const double sin = std::sin(direction_rad);
  covariance_(kX, kX) += along * cos * cos + turning;
  covariance_(kY, kY) += along * sin * sin + turning;
  covariance_(kX, kY) += along * cos * sin;
  covariance_(kY, kX) += along * cos * sin;
}

void DeadReckoning::stand(double duration_s, double gyro_rate_radps) {
  covariance_(kBias, kBias) += square(parameters_.gyro_bias_walk_radps_per_sqrt_s) * duration_s;
  const double noise = square(parameters_.gyro_noise_radps_per_sqrt_hz) / duration_s;
  const State column = covariance_.col(kBias);
  const double innovation_variance = column[kBias] + noise;
  state_ += column * ((gyro_rate_radps - state_[kBias]) / innovation_variance);
  covariance_ -= column * column.transpose() / innovation_variance;
  state_[kHeading] = std::remainder(state_[kHeading], 2.0 * M_PI);
}

double DeadReckoning::heading_rad() const { return state_[kHeading] == -M_PI ? M_PI : state_[kHeading]; }

double DeadReckoning::gyro_bias_sigma_radps() const { return std::sqrt(covariance_(kBias, kBias)); }

double DeadReckoning::corrected_rate(double gyro_rate_radps) const {
  return (1.0 + state_[kGyroScale]) * (gyro_rate_radps - state_[kBias]);
}

double DeadReckoning::corrected_speed(double wheel_speed_mps) const {
  return (1.0 + state_[kWheelScale]) * wheel_speed_mps;
}

std::array<double, 9> DeadReckoning::pose_covariance() const {
  std::array<double, 9> rows{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      rows[static_cast<std::size_t>(3 * row + column)] = covariance_(row, column);
    }
  }
  return rows;
}

}  // namespace mtr_localization
