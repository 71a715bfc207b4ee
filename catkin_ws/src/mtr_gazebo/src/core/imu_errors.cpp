// SPDX-License-Identifier: Apache-2.0
#include "core/imu_errors.hpp"

#include <cmath>
#include <cstddef>

namespace mtr_gazebo {

ImuErrors::ImuErrors(const ImuFigures& figures, double period_s, std::uint64_t seed)
    : figures_(figures), period_s_(period_s), random_(seed) {
  for (std::size_t axis = 0; axis < gyro_bias_.size(); ++axis) {
    gyro_bias_[axis] = figures_.gyro_bias_radps * normal();
    accelerometer_bias_[axis] = figures_.accelerometer_bias_mps2 * normal();
  }
}

ImuReading ImuErrors::read(const ImuReading& truth) {
  ImuReading reading;
  for (std::size_t axis = 0; axis < gyro_bias_.size(); ++axis) {
    gyro_bias_[axis] += figures_.gyro_bias_walk * std::sqrt(period_s_) * normal();
    accelerometer_bias_[axis] += figures_.accelerometer_bias_walk * std::sqrt(period_s_) * normal();
    reading.rate[axis] = (1.0 + figures_.gyro_scale_error) * truth.rate[axis] + gyro_bias_[axis] +
                         figures_.gyro_density / std::sqrt(period_s_) * normal();
    reading.force[axis] = truth.force[axis] + accelerometer_bias_[axis] +
                          figures_.accelerometer_density / std::sqrt(period_s_) * normal();
  }
  return reading;
}

double ImuErrors::normal() { return distribution_(random_); }

}  // namespace mtr_gazebo
