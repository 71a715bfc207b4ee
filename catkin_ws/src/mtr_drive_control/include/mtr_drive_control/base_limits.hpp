/// @file
/// Limits of the base's own stop without commands, and check that the mast survives it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Time from the last command until the base's controller stops, in s: longer than any delay of drive control, and
/// short enough for a stop.
inline constexpr double kMinBaseTimeoutS = 0.06;
inline constexpr double kMaxBaseTimeoutS = 0.3;
/// Share of the static tip-over limit that a stop by the base may use with the key raised. In simulation, from 0.75
/// m/s, a base that stops by its time-out at 2.5 m/s2 leaves 5.9 of 62 N on the lightest wheel, and 1.3 N at 2.7 m/s2.
/// At 3 m/s2 wheels lift off for 0.16 s, at a bare Jackal's 20 m/s2 for half a second.
inline constexpr double kBaseTipShare = 0.68;
/// With 6 rad/s2 the stop of the fastest turn on the spot leaves 60 N.
inline constexpr double kMaxBaseAngularRadps2 = 8.0;

/// Parameters of the base's controller.
struct BaseLimits {
  double command_timeout_s;
  double linear_acceleration_mps2;
  double angular_acceleration_radps2;
};

/// Throws mtr_core::ConfigurationError if the base brakes harder than the mast survives, or less than drive control's
/// emergency stop requires.
/// @param name namespace of the base's parameters, for the sentence
void check(const BaseLimits& base, const Parameters& parameters, const std::string& name);

/// Returns the limit that differs from its value at the start, with both values; empty if none differs.
std::string changed_limit(const BaseLimits& start, const BaseLimits& now, const std::string& name);

}  // namespace mtr_drive_control
