/// @file
/// Plausible ranges of the sensors on a robot of this class. No ROS.
///
/// Each function is false for a value that such a robot cannot reach, and for NaN: a broken device, or a wrong cast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace mtr_core {

/// The robot turns by at most 4 rad/s; a robot that is pushed over or dropped stays below twice that rate.
constexpr double kMaxTurnRadps = 10.0;
/// 16 times gravity, the largest range of accelerometers on robots.
constexpr double kMaxForceMps2 = 160.0;
/// No base of this class is faster.
constexpr double kMaxWheelsMps = 3.0;

inline bool is_turn_rate(double radps) { return std::abs(radps) <= kMaxTurnRadps; }
inline bool is_force(double mps2) { return std::abs(mps2) <= kMaxForceMps2; }
inline bool is_wheel_speed(double mps) { return std::abs(mps) <= kMaxWheelsMps; }

}  // namespace mtr_core
