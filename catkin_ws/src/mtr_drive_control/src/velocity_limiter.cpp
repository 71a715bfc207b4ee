/// @file
/// Limits of speed, acceleration and lateral acceleration.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/velocity_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {

bool Velocity::is_finite() const { return std::isfinite(linear_mps) && std::isfinite(angular_radps); }

Velocity VelocityLimiter::follow(const Velocity& wanted) {
  const Velocity target = within_limits(wanted);
  sent_.linear_mps = next_linear(target.linear_mps);
  const double angular_step = parameters_.angular_acceleration_radps2 * period_s_;
  sent_.angular_radps =
      std::clamp(target.angular_radps, sent_.angular_radps - angular_step, sent_.angular_radps + angular_step);
  const double lateral_mps2 = std::abs(sent_.linear_mps * sent_.angular_radps);
  if (lateral_mps2 > parameters_.lateral_acceleration_mps2) {
    sent_.angular_radps *= parameters_.lateral_acceleration_mps2 / lateral_mps2;
  }
  return sent_;
}

Velocity VelocityLimiter::stop() {
  const double remaining_s =
      std::max(std::abs(sent_.linear_mps) / parameters_.emergency_linear_deceleration_mps2,
               std::abs(sent_.angular_radps) / parameters_.emergency_angular_deceleration_radps2);
  // A remainder below a thousandth of a period is rounding, not a reason for another tick of motion.
  const double kept = remaining_s > 1.001 * period_s_ ? 1.0 - period_s_ / remaining_s : 0.0;
  sent_ = {sent_.linear_mps * kept, sent_.angular_radps * kept};
  return sent_;
}

Velocity VelocityLimiter::within_limits(const Velocity& wanted) const {
  double factor = std::min(1.0, parameters_.max_linear_mps / std::abs(wanted.linear_mps));
  factor = std::min(factor, parameters_.max_angular_radps / std::abs(wanted.angular_radps));
  const double lateral_mps2 = std::abs(wanted.linear_mps) * std::abs(wanted.angular_radps);
  factor = std::min(factor, std::sqrt(parameters_.lateral_acceleration_mps2 / lateral_mps2));
  return {wanted.linear_mps * factor, wanted.angular_radps * factor};
}

double VelocityLimiter::next_linear(double wanted_mps) const {
  const double now_mps = sent_.linear_mps;
  if (now_mps == 0.0) {
    const double step = parameters_.linear_acceleration_mps2 * period_s_;
    return std::clamp(wanted_mps, -step, step);
  }
  // In the direction of travel: faster by acceleration, slower by deceleration, and never through zero in one step.
  const double sign = now_mps > 0.0 ? 1.0 : -1.0;
  const double speed_mps = std::abs(now_mps);
  const double slowest = std::max(0.0, speed_mps - parameters_.linear_deceleration_mps2 * period_s_);
  const double fastest = speed_mps + parameters_.linear_acceleration_mps2 * period_s_;
  return sign * std::clamp(sign * wanted_mps, slowest, fastest);
}

}  // namespace mtr_drive_control
