/// @file
/// Limits of speed, acceleration and lateral acceleration.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/velocity_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {

Velocity VelocityLimiter::toward(const Velocity& wanted) const {
  const Velocity target = within_limits(wanted);
  Velocity next{next_linear(target.linear_mps), next_angular(target.angular_radps)};
  const double most_radps = limits_.yaw_rate_at_radps(next.linear_mps);
  next.angular_radps = std::clamp(next.angular_radps, -most_radps, most_radps);
  return next;
}

Velocity VelocityLimiter::braked() const {
  const double remaining_s = limits_.stop_time_s(sent_);
  // A remainder below a thousandth of a period is rounding and needs no further tick of motion.
  const double kept = remaining_s > 1.001 * braking_s_ ? 1.0 - braking_s_ / remaining_s : 0.0;
  return sent_.scaled(kept);
}

bool VelocityLimiter::leads(const Velocity& measured) const {
  const auto is_ahead = [](double sent, double done, double lead) {
    return sent > std::max(0.0, done) + lead || sent < std::min(0.0, done) - lead;
  };
  return is_ahead(sent_.linear_mps, measured.linear_mps, limits_.max_lead_mps) ||
         is_ahead(sent_.angular_radps, measured.angular_radps, limits_.max_lead_radps);
}

double VelocityLimiter::next_linear(double wanted_mps) const {
  const double now_mps = sent_.linear_mps;
  if (now_mps == 0.0) {
    const double step = limits_.linear_acceleration_mps2 * period_s_;
    return std::clamp(wanted_mps, -step, step);
  }
  // In the direction of travel: acceleration when faster, deceleration when slower, and never through zero in one step.
  const double sign = now_mps > 0.0 ? 1.0 : -1.0;
  const double speed_mps = std::abs(now_mps);
  const double slowest = std::max(0.0, speed_mps - limits_.linear_deceleration_mps2 * braking_s_);
  const double fastest = speed_mps + limits_.linear_acceleration_mps2 * period_s_;
  return sign * std::clamp(sign * wanted_mps, slowest, fastest);
}

double VelocityLimiter::next_angular(double wanted_radps) const {
  const double sign = sent_.angular_radps < 0.0 ? -1.0 : 1.0;
  const double rate_radps = std::abs(sent_.angular_radps);
  const double step_radps = limits_.angular_acceleration_radps2 * period_s_;
  // The turn may be reversed within a step, limited to the rate of a start.
  const double slowest = std::max(rate_radps - limits_.angular_acceleration_radps2 * braking_s_, -step_radps);
  return sign * std::clamp(sign * wanted_radps, slowest, rate_radps + step_radps);
}

}  // namespace mtr_drive_control
