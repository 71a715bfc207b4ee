/// @file
/// Distance driven by wheel odometry.
// SPDX-License-Identifier: Apache-2.0
#include "samples.hpp"

#include <cmath>

namespace mtr_localization {

bool WheelSample::is_finite() const {
  return std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(heading_rad) && std::isfinite(linear_mps) &&
         std::isfinite(angular_radps);
}

double WheelSample::distance_since(const WheelSample& earlier) const {
  const double half_turn = 0.5 * std::remainder(heading_rad - earlier.heading_rad, 2.0 * M_PI);
  const double mean_heading = earlier.heading_rad + half_turn;
  const double chord = (x_m - earlier.x_m) * std::cos(mean_heading) + (y_m - earlier.y_m) * std::sin(mean_heading);
  return std::abs(half_turn) < 1e-6 ? chord : chord * half_turn / std::sin(half_turn);
}

}  // namespace mtr_localization
