/// @file
/// Accelerations at which the wheels keep their load, by the height of the key on the mast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Limits in force with the key at some height.
struct Limits : Parameters {
  explicit Limits(const Parameters& parameters) : Parameters(parameters) {}

  /// Speed whose emergency stop, on a straight line, takes as long as that of this velocity on its circle.
  double straight_speed_mps(const Velocity& velocity) const;

  /// Deceleration of an emergency stop from this velocity; the same all along its circle.
  double emergency_deceleration_mps2(const Velocity& velocity) const;

  /// Straight speed from which that stop takes kStopWithinS.
  double fastest_straight_mps() const { return kStopWithinS * emergency_linear_deceleration_mps2; }

  /// Duration of that stop in s.
  double stop_time_s(const Velocity& velocity) const;

  /// Largest yaw rate, without sign, at this speed.
  double yaw_rate_at_radps(double linear_mps) const;

  /// Largest share of a velocity, 1 at most, that respects all limits on the same circle.
  double permitted_share(const Velocity& velocity) const;
};

/// Deceleration at which the robot would tip over its front wheels if it were stiff, with the key at this height.
double static_limit_mps2(const Parameters& parameters, double key_height_m);

/// The limits that hold with the key at this height above ground: static tip-over limit times its margin.
///
/// A body on wheels tips when acceleration * height of the centre of mass exceeds g * its horizontal distance from the
/// wheels' line. The permitted speed is lowered with the emergency deceleration, so that a stop still ends in time.
Limits limits_at(const Parameters& parameters, double key_height_m);

}  // namespace mtr_drive_control
