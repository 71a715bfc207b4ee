/// @file
/// Plausibility of readings, and driven distance from wheel odometry.
// SPDX-License-Identifier: Apache-2.0
#include "samples.hpp"

#include <algorithm>
#include <cmath>

#include "mtr_core/plausible.hpp"

namespace mtr_localization {

bool ImuSample::is_plausible() const {
  // A yaw rate is required for the heading; unmeasured tilt rates or forces may be NaN.
  const auto is_none_or = [](double value, bool is_possible) { return std::isnan(value) || is_possible; };
  return mtr_core::is_turn_rate(yaw_rate_radps) &&
         is_none_or(tilt_rate_radps.x(), mtr_core::is_turn_rate(tilt_rate_radps.x())) &&
         is_none_or(tilt_rate_radps.y(), mtr_core::is_turn_rate(tilt_rate_radps.y())) &&
         std::all_of(force_mps2.data(), force_mps2.data() + force_mps2.size(),
                     [&](double value) { return is_none_or(value, mtr_core::is_force(value)); });
}

bool WheelSample::is_plausible() const {
  return std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(heading_rad) &&
         mtr_core::is_wheel_speed(linear_mps) && mtr_core::is_turn_rate(angular_radps);
}

double WheelSample::distance_since(const WheelSample& earlier) const {
  const double half_turn = 0.5 * std::remainder(heading_rad - earlier.heading_rad, 2.0 * M_PI);
  const double mean_heading = earlier.heading_rad + half_turn;
  const double chord = (x_m - earlier.x_m) * std::cos(mean_heading) + (y_m - earlier.y_m) * std::sin(mean_heading);
  return std::abs(half_turn) < 1e-6 ? chord : chord * half_turn / std::sin(half_turn);
}

}  // namespace mtr_localization
