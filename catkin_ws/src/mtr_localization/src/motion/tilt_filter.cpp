/// @file
/// Integration of the gyro, corrected towards gravity.
// SPDX-License-Identifier: Apache-2.0
#include "motion/tilt_filter.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_localization {
namespace {

constexpr double kGravityMps2 = 9.81;
// A larger deviation from gravity is a shock, or an IMU that is mounted upside down or broken. Driving and braking in
// simulation deviate by at most 2.1 laterally; a robot that is put down by 10 and more.
constexpr double kMaxDifferenceMps2 = 2.5;
// A longer deviation is not a shock, but an error of the filter.
constexpr double kMaxBlowS = 1.0;
// Time constant from gyro to gravity. Measured in simulation on slopes of 1 deg: with 1 to 4 s, the error without the
// accelerometer bias is 0.1 deg.
constexpr double kSettlingS = 2.0;
// Averaging time of the gyro bias at standstill.
constexpr double kBiasMeanS = 5.0;

}  // namespace

void TiltFilter::advance(double duration_s, const ImuSample& imu, double speed_mps, bool standing) {
  const double acceleration_mps2 = duration_s > 0.0 ? (speed_mps - speed_mps_) / duration_s : 0.0;
  speed_mps_ = speed_mps;
  const Eigen::Vector2d own(acceleration_mps2, speed_mps * imu.yaw_rate_radps);
  const Eigen::Vector3d& force = imu.force_mps2;
  const bool shows_gravity = std::abs(force.z() - kGravityMps2) < kMaxDifferenceMps2 && force.allFinite();
  if (!shows_gravity || !imu.tilt_rate_radps.allFinite()) {
    return;
  }
  const Eigen::Vector2d by_gravity = (force.head<2>() - own) / kGravityMps2;
  if (!is_known_) {
    slope_ = by_gravity;
    is_known_ = true;
    return;
  }
  // A positive turn about y lowers the nose.
  const Eigen::Vector2d rise_rate(-imu.tilt_rate_radps.y(), imu.tilt_rate_radps.x());
  if (standing) {
    measure_bias(duration_s, rise_rate);
  }
  const Eigen::Vector2d by_yaw = imu.yaw_rate_radps * Eigen::Vector2d(slope_.y(), -slope_.x());
  slope_ += duration_s * (rise_rate - bias_ + by_yaw);
  const bool is_blow = kGravityMps2 * (by_gravity - slope_).norm() > kMaxDifferenceMps2;
  blow_s_ = is_blow ? blow_s_ + duration_s : 0.0;
  if (!is_blow || blow_s_ > kMaxBlowS) {
    slope_ += std::min(1.0, duration_s / kSettlingS) * (by_gravity - slope_);
  }
}

void TiltFilter::measure_bias(double duration_s, const Eigen::Vector2d& rise_rate) {
  bias_time_s_ = std::min(bias_time_s_ + duration_s, kBiasMeanS);
  bias_ += duration_s / bias_time_s_ * (rise_rate - bias_);
}

}  // namespace mtr_localization
