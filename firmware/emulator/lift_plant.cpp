/// @file
/// First-order motor between two stops.
// SPDX-License-Identifier: Apache-2.0
#include "lift_plant.hpp"

#include <algorithm>
#include <cmath>

namespace emulator {

void LiftPlant::step(double duty, double dt_s) {
  const double beyond_friction = std::max(0.0, std::abs(duty) - parameters_.friction_duty);
  const double share = beyond_friction / (1.0 - parameters_.friction_duty) * (duty > 0.0 ? parameters_.upwards : 1.0);
  const double wanted_mps = std::copysign(share * parameters_.speed_mps, duty);
  speed_mps_ += (wanted_mps - speed_mps_) * std::min(1.0, dt_s / parameters_.lag_s);
  if (is_jammed_) {
    speed_mps_ = 0.0;
  }
  const double height_m = height_m_ + speed_mps_ * dt_s;
  height_m_ = std::clamp(height_m, 0.0, parameters_.stroke_m);
  if (height_m != height_m_) {
    speed_mps_ = 0.0;
  }
}

double LiftPlant::sensor_mv() {
  // Drawn always, so that a fault does not change the noise that follows it.
  const double noise = parameters_.noise_mv * (2.0 * static_cast<double>(random_()) / std::mt19937::max() - 1.0);
  if (is_broken_) {
    return 0.0;
  }
  const double share = height_m_ / parameters_.stroke_m;
  return parameters_.low_mv + share * (parameters_.high_mv - parameters_.low_mv) + noise;
}

}  // namespace emulator
