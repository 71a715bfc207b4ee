/// @file
/// What the base does by itself when nobody commands it any more, and whether the mast survives that.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// The base's controller stops so long after the last command, in s: longer than drive control is ever late, and short
/// enough to be a stop.
inline constexpr double kMinBaseTimeoutS = 0.06;
inline constexpr double kMaxBaseTimeoutS = 0.3;
/// Share of the static tip-over limit that a stop by the base may use with the key raised. In simulation, out of 0.75
/// m/s, a base that stops by its time-out at 2.5 m/s2 leaves 5.9 of 62 N on the lightest wheel and at 2.7 m/s2 1.3 N;
/// at 3 m/s2 wheels are in the air for 0.16 s, at a bare Jackal's 20 m/s2 for half a second.
inline constexpr double kBaseTipShare = 0.68;
/// With 6 rad/s2 the stop of the fastest turn on the spot leaves 60 N.
inline constexpr double kMaxBaseAngularRadps2 = 8.0;

/// Parameters of the base's controller.
struct BaseLimits {
  double command_timeout_s;
  double linear_acceleration_mps2;
  double angular_acceleration_radps2;
};

/// Throws mtr_core::ConfigurationError when the base brakes harder than the mast survives, or less than drive control's
/// emergency stop needs.
/// @param name namespace of the base's parameters, for the sentence
void check(const BaseLimits& base, const Parameters& parameters, const std::string& name);

/// The limit that differs from the one at the start, with both values; empty when none does.
std::string changed_limit(const BaseLimits& start, const BaseLimits& now, const std::string& name);

}  // namespace mtr_drive_control
