/// @file
/// Accelerations at which all wheels keep their load, by the height of the key on the mast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Limits for a height of the key.
struct Limits : Parameters {
  explicit Limits(const Parameters& parameters) : Parameters(parameters) {}

  /// Speed with an emergency stop, on a straight line, of the same duration as from this velocity on its circle.
  double straight_speed_mps(const Velocity& velocity) const;

  /// Deceleration of an emergency stop from this velocity; constant along its circle.
  double emergency_deceleration_mps2(const Velocity& velocity) const;

  /// Straight speed with an emergency stop of duration kStopWithinS.
  double fastest_straight_mps() const { return kStopWithinS * emergency_linear_deceleration_mps2; }

  /// Duration of that stop in s.
  double stop_time_s(const Velocity& velocity) const;

  /// Largest yaw rate, without sign, at this speed.
  double yaw_rate_at_radps(double linear_mps) const;

  /// Largest share of a velocity, at most 1, that keeps all limits on the same circle.
  double permitted_share(const Velocity& velocity) const;
};

/// Deceleration at which a rigid robot would tip over its front wheels, with the key at this height.
double static_limit_mps2(const Parameters& parameters, double key_height_m);

/// Limits with the key at this height above ground and the ground tilted by this angle: static tip-over limit times its
/// margin.
///
/// A body on wheels tips if acceleration * height of the centre of mass exceeds g * its horizontal distance from the
/// wheels' line. The permitted speed is reduced with the emergency deceleration, so that the duration of a stop is
/// unchanged.
///
/// On a slope of angle s the weight pulls with g * sin(s) downhill, in the tipping direction of a stop on the way down.
/// This worst case is assumed for each direction. The margin covers tilt_slow_rad, and the excess is subtracted: the
/// deceleration is reduced by g * sin(s - tilt_slow_rad), and the other accelerations in the same ratio. A stop on a
/// steeper slope thus loads the wheels no more than one at tilt_slow_rad. The speed decreases linearly to
/// tilt_creep_mps at tilt_stop_rad, because the base's own stop brakes as hard as on level ground: from a low speed
/// that stop ends before the robot tips.
Limits limits_at(const Parameters& parameters, double key_height_m, double tilt_rad = 0.0);

}  // namespace mtr_drive_control
