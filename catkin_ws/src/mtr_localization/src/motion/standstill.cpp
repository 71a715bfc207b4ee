/// @file
/// Detection of standstill from wheels and gyro.
// SPDX-License-Identifier: Apache-2.0
#include "motion/standstill.hpp"

#include <cmath>

namespace mtr_localization {

void StandstillDetector::update(const WheelSample& wheels, double yaw_rate_radps) {
  now_ns_ = wheels.stamp_ns;
  const bool resting = std::abs(wheels.linear_mps) <= parameters_.standstill_linear_mps &&
                       std::abs(wheels.angular_radps) <= parameters_.standstill_angular_radps &&
                       std::abs(yaw_rate_radps) <= parameters_.standstill_gyro_radps;
  if (!resting) {
    resting_since_ns_.reset();
  } else if (!resting_since_ns_) {
    resting_since_ns_ = now_ns_;
  }
}

double StandstillDetector::standing_s() const {
  return resting_since_ns_
             ? static_cast<double>(now_ns_ - *resting_since_ns_) * 1e-9 - parameters_.standstill_settling_s
             : -1.0;
}

}  // namespace mtr_localization
