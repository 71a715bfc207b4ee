/// @file
/// Limits of speed, acceleration and lateral acceleration.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/velocity_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {

Velocity VelocityLimiter::toward(const Velocity& wanted) const {
  const Velocity target = within_limits(wanted);
  Velocity next{next_linear(target.linear_mps), 0.0};
  const double angular_step = limits_.angular_acceleration_radps2 * period_s_;
  next.angular_radps =
      std::clamp(target.angular_radps, sent_.angular_radps - angular_step, sent_.angular_radps + angular_step);
  const double lateral_mps2 = std::abs(next.linear_mps * next.angular_radps);
  if (lateral_mps2 > limits_.lateral_acceleration_mps2) {
    next.angular_radps *= limits_.lateral_acceleration_mps2 / lateral_mps2;
  }
  return next;
}

Velocity VelocityLimiter::braked() const {
  const double remaining_s = std::max(std::abs(sent_.linear_mps) / limits_.emergency_linear_deceleration_mps2,
                                      std::abs(sent_.angular_radps) / limits_.emergency_angular_deceleration_radps2);
  // A remainder below a thousandth of a period is rounding, not a reason for another tick of motion.
  const double kept = remaining_s > 1.001 * period_s_ ? 1.0 - period_s_ / remaining_s : 0.0;
  return sent_.scaled(kept);
}

Velocity VelocityLimiter::within_limits(const Velocity& wanted) const {
  double factor = std::min(1.0, limits_.max_linear_mps / std::abs(wanted.linear_mps));
  factor = std::min(factor, limits_.max_angular_radps / std::abs(wanted.angular_radps));
  const double lateral_mps2 = std::abs(wanted.linear_mps) * std::abs(wanted.angular_radps);
  factor = std::min(factor, std::sqrt(limits_.lateral_acceleration_mps2 / lateral_mps2));
  return wanted.scaled(factor);
}

double VelocityLimiter::next_linear(double wanted_mps) const {
  const double now_mps = sent_.linear_mps;
  if (now_mps == 0.0) {
    const double step = limits_.linear_acceleration_mps2 * period_s_;
    return std::clamp(wanted_mps, -step, step);
  }
  // In the direction of travel: faster by acceleration, slower by deceleration, and never through zero in one step.
  const double sign = now_mps > 0.0 ? 1.0 : -1.0;
  const double speed_mps = std::abs(now_mps);
  const double slowest = std::max(0.0, speed_mps - limits_.linear_deceleration_mps2 * period_s_);
  const double fastest = speed_mps + limits_.linear_acceleration_mps2 * period_s_;
  return sign * std::clamp(sign * wanted_mps, slowest, fastest);
}

}  // namespace mtr_drive_control
