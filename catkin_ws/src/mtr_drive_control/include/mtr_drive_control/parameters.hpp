/// @file
/// Parameters of drive control: limits of motion and time-outs, SI units.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mtr_core/parameter.hpp"

namespace mtr_drive_control {

/// Maximum time from the last message of a silent sender to standstill, in s, from any permitted velocity.
inline constexpr double kStandstillWithinS = 0.5;
/// Maximum duration of a stop from any permitted velocity, in s: in normal operation the oldest message is 0.1 s old (a
/// lock's), 0.02 s late, and the stop begins a period later.
inline constexpr double kStopWithinS = 0.36;

/// Limits of the wheel commands; tip_over.hpp reduces the accelerations further.
struct Parameters {
  double max_linear_mps = 1.0;
  double max_angular_radps = 1.5;
  double linear_acceleration_mps2 = 1.0;
  double linear_deceleration_mps2 = 1.5;
  double angular_acceleration_radps2 = 2.0;
  /// Bound of |linear * angular|.
  double lateral_acceleration_mps2 = 1.0;
  /// Deceleration of stops by a lock, a dead source or a sudden obstacle.
  double emergency_linear_deceleration_mps2 = 3.0;
  double emergency_angular_deceleration_radps2 = 5.0;
  /// An owner of a motion lock silent for longer counts as engaged; it publishes every 0.1 s.
  double lock_timeout_s = 0.25;
  /// A source of velocity commands silent for longer counts as dead; it publishes every 0.04 s.
  double command_timeout_s = 0.14;
  /// Share of the static tip-over limit that is used. On its tyres the robot pitches by an additional half in sudden
  /// braking, and the ground is not level. In simulation, with the lift up, the hardest stops leave 10.6 of 62 N on the
  /// lightest wheel (mtr_benchmarks/motion/tip_over.py).
  double tip_margin = 0.52;
  /// Height of the centre of mass above ground: this plus the rise times the height of the key. Derived from the masses
  /// and positions in mtr_description's URDF; a unit test compares them.
  double centre_of_mass_m = 0.2665;
  double centre_of_mass_rise = 0.0345;
  /// Horizontal distance of the centre of mass from the line through the wheels' contact points, along and across.
  double tip_lever_along_m = 0.13;
  double tip_lever_across_m = 0.187;
  /// In a curve a skid-steered robot slides sideways, and harder braking lets its front tyres push it farther aside. A
  /// stop there loads the wheels like one from a speed that is higher by this times the yaw rate. Measured in
  /// simulation: the emergency decelerations that leave 10 N at curvatures of 0.3 to 4 1/m.
  double curve_lever_m = 0.25;
  /// Height of the key at the upper stop; assumed while the peripherals are silent.
  double key_raised_m = 1.55;
  /// Age at which the height of the key is unknown; the peripherals publish every 0.1 s.
  double peripherals_timeout_s = 0.5;
  /// A velocity command that exceeds the wheels' speed by this is braked: they do not follow it, and would overshoot
  /// later. At 1 m/s2 and 2 rad/s2 it is the lag of a base with response times of 0.3 and 0.4 s.
  double max_lead_mps = 0.3;
  double max_lead_radps = 0.8;
  /// Tilt from which speed and accelerations are reduced: 2 deg. Joints and waves of a car park are below.
  double tilt_slow_rad = 0.0349;
  /// Tilt at which the robot stops: 4 deg. tip_over.hpp derives the limits of the mast there.
  double tilt_stop_rad = 0.0698;
  /// Maximum speed at that tilt, and while a person drives the robot off a steeper slope.
  double tilt_creep_mps = 0.15;
};

using Row = mtr_core::ParameterRow<Parameters>;

/// Range and unit of each parameter.
inline constexpr std::array<Row, 23> kRows{{
    {"max_linear_mps", &Parameters::max_linear_mps, 0.05, 2.0, "m/s"},
    {"max_angular_radps", &Parameters::max_angular_radps, 0.1, 4.0, "rad/s"},
    {"linear_acceleration_mps2", &Parameters::linear_acceleration_mps2, 0.1, 3.0, "m/s2"},
    {"linear_deceleration_mps2", &Parameters::linear_deceleration_mps2, 0.1, 3.0, "m/s2"},
    {"angular_acceleration_radps2", &Parameters::angular_acceleration_radps2, 0.1, 10.0, "rad/s2"},
    {"lateral_acceleration_mps2", &Parameters::lateral_acceleration_mps2, 0.1, 3.0, "m/s2"},
    {"emergency_linear_deceleration_mps2", &Parameters::emergency_linear_deceleration_mps2, 0.1, 10.0, "m/s2"},
    {"emergency_angular_deceleration_radps2", &Parameters::emergency_angular_deceleration_radps2, 0.2, 20.0, "rad/s2"},
    {"lock_timeout_s", &Parameters::lock_timeout_s, 0.12, 2.0, "s"},
    {"command_timeout_s", &Parameters::command_timeout_s, 0.08, 1.0, "s"},
    {"tip_margin", &Parameters::tip_margin, 0.1, 0.95, "(ratio)"},
    {"centre_of_mass_m", &Parameters::centre_of_mass_m, 0.05, 1.5, "m"},
    {"centre_of_mass_rise", &Parameters::centre_of_mass_rise, 0.0, 0.5, "(ratio)"},
    {"tip_lever_along_m", &Parameters::tip_lever_along_m, 0.05, 0.5, "m"},
    {"tip_lever_across_m", &Parameters::tip_lever_across_m, 0.05, 0.5, "m"},
    {"curve_lever_m", &Parameters::curve_lever_m, 0.01, 1.0, "m"},
    {"key_raised_m", &Parameters::key_raised_m, 0.1, 3.0, "m"},
    {"peripherals_timeout_s", &Parameters::peripherals_timeout_s, 0.2, 5.0, "s"},
    {"max_lead_mps", &Parameters::max_lead_mps, 0.1, 2.0, "m/s"},
    {"max_lead_radps", &Parameters::max_lead_radps, 0.2, 4.0, "rad/s"},
    {"tilt_slow_rad", &Parameters::tilt_slow_rad, 0.0, 0.0873, "rad"},
    {"tilt_stop_rad", &Parameters::tilt_stop_rad, 0.01, 0.1745, "rad"},
    {"tilt_creep_mps", &Parameters::tilt_creep_mps, 0.05, 0.3, "m/s"},
}};

/// Throws ConfigurationError unless each value is in its range, an emergency stop ends within kStopWithinS, and the
/// slow tilt is smaller than the stop tilt.
void check(const Parameters& parameters);

}  // namespace mtr_drive_control
