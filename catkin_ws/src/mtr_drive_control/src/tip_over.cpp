/// @file
/// Static tip-over limit.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/tip_over.hpp"

#include <algorithm>
#include <cmath>

namespace mtr_drive_control {
namespace {

constexpr double kGravityMps2 = 9.81;

double centre_of_mass_m(const Parameters& parameters, double key_height_m) {
  // An unknown height, NaN, counts as a raised mast.
  const double height_m =
      key_height_m >= 0.0 ? std::min(key_height_m, parameters.key_raised_m) : parameters.key_raised_m;
  return parameters.centre_of_mass_m + parameters.centre_of_mass_rise * height_m;
}

// A robot that lies on its side still needs a positive deceleration; it does not move there.
constexpr double kLeastShare = 0.15;
constexpr double kUprightRad = 1.5;

/// Share of an acceleration limit that remains if the slope pulls with this acceleration.
double share_left(double limit_mps2, double pull_mps2) { return std::max(kLeastShare, 1.0 - pull_mps2 / limit_mps2); }

/// Reduces the limits of level ground to the limits of a slope.
void reduce(Limits& limits, double along_mps2, double across_mps2, double tilt_rad) {
  const double excess_rad = std::min(tilt_rad, kUprightRad) - limits.tilt_slow_rad;
  const double pull_mps2 = kGravityMps2 * std::sin(excess_rad);
  const double share = share_left(along_mps2, pull_mps2);
  for (double Parameters::*each : {&Parameters::linear_acceleration_mps2, &Parameters::linear_deceleration_mps2,
                                   &Parameters::emergency_linear_deceleration_mps2}) {
    limits.*each *= share;
  }
  limits.lateral_acceleration_mps2 *= share_left(across_mps2, pull_mps2);
  const double steepness = std::min(1.0, excess_rad / (limits.tilt_stop_rad - limits.tilt_slow_rad));
  const auto slowed = [steepness](double level, double creep) {
    return level + steepness * (std::min(level, creep) - level);
  };
  limits.max_linear_mps = std::min(slowed(limits.max_linear_mps, limits.tilt_creep_mps), limits.fastest_straight_mps());
  // Yaw rate with a stop that loads the wheels like one from this speed.
  limits.max_angular_radps = slowed(limits.max_angular_radps, limits.tilt_creep_mps / limits.curve_lever_m);
}

}  // namespace

double Limits::straight_speed_mps(const Velocity& velocity) const {
  return std::abs(velocity.linear_mps) + curve_lever_m * std::abs(velocity.angular_radps);
}

double Limits::emergency_deceleration_mps2(const Velocity& velocity) const {
  const double share = velocity.linear_mps == 0.0 ? 1.0 : std::abs(velocity.linear_mps) / straight_speed_mps(velocity);
  return emergency_linear_deceleration_mps2 * share;
}

double Limits::stop_time_s(const Velocity& velocity) const {
  const double linear_s =
      velocity.linear_mps == 0.0 ? 0.0 : straight_speed_mps(velocity) / emergency_linear_deceleration_mps2;
  return std::max(linear_s, std::abs(velocity.angular_radps) / emergency_angular_deceleration_radps2);
}

double Limits::yaw_rate_at_radps(double linear_mps) const {
  const double speed_mps = std::abs(linear_mps);
  const double stoppable_radps = std::max(0.0, fastest_straight_mps() - speed_mps) / curve_lever_m;
  return std::min({max_angular_radps, lateral_acceleration_mps2 / speed_mps, stoppable_radps});
}

double Limits::permitted_share(const Velocity& velocity) const {
  const double lateral_mps2 = std::abs(velocity.linear_mps * velocity.angular_radps);
  return std::min(
      {1.0, max_linear_mps / std::abs(velocity.linear_mps), max_angular_radps / std::abs(velocity.angular_radps),
       std::sqrt(lateral_acceleration_mps2 / lateral_mps2), fastest_straight_mps() / straight_speed_mps(velocity)});
}

double static_limit_mps2(const Parameters& parameters, double key_height_m) {
  return kGravityMps2 * parameters.tip_lever_along_m / centre_of_mass_m(parameters, key_height_m);
}

Limits limits_at(const Parameters& parameters, double key_height_m, double tilt_rad) {
  const double per_lever = parameters.tip_margin * kGravityMps2 / centre_of_mass_m(parameters, key_height_m);
  const double along_mps2 = per_lever * parameters.tip_lever_along_m;
  const double across_mps2 = per_lever * parameters.tip_lever_across_m;
  Limits limits(parameters);
  for (double Parameters::*each : {&Parameters::linear_acceleration_mps2, &Parameters::linear_deceleration_mps2,
                                   &Parameters::emergency_linear_deceleration_mps2}) {
    limits.*each = std::min(parameters.*each, along_mps2);
  }
  limits.lateral_acceleration_mps2 = std::min(parameters.lateral_acceleration_mps2, across_mps2);
  limits.max_linear_mps = std::min(parameters.max_linear_mps, limits.fastest_straight_mps());
  if (tilt_rad > parameters.tilt_slow_rad) {
    reduce(limits, along_mps2, across_mps2, tilt_rad);
  }
  return limits;
}

}  // namespace mtr_drive_control
