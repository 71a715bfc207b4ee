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

/// The limits that hold with the key at this height above ground and the ground tilted by this angle: static tip-over
/// limit times its margin.
///
/// A body on wheels tips when acceleration * height of the centre of mass exceeds g * its horizontal distance from the
/// wheels' line. The permitted speed is lowered with the emergency deceleration, so that a stop still ends in time.
///
/// On a slope of angle s the weight pulls with g * sin(s) downhill, in the direction in which a stop on the way down
/// throws the body. That is the worst case, and it is assumed for each direction. The margin leaves room for
/// tilt_slow_rad; what exceeds it is subtracted: the deceleration is lowered by g * sin(s - tilt_slow_rad), and the
/// other accelerations in the same ratio. So a stop on a steeper slope loads the wheels no more than one at
/// tilt_slow_rad. The speed falls evenly to tilt_creep_mps at tilt_stop_rad, as the base's own stop brakes as hard as
/// on level ground: from a small speed that stop ends before the robot has tipped.
Limits limits_at(const Parameters& parameters, double key_height_m, double tilt_rad = 0.0);

}  // namespace mtr_drive_control
