/// @file
/// What sensors on a robot of this class can show. No ROS.
///
/// Each function is false for what no such robot does, and for what is no number: a broken device, or a wrong cast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace mtr_core {

/// It turns itself by at most 4 rad/s; one that is pushed over or dropped is not twice as fast.
constexpr double kMaxTurnRadps = 10.0;
/// 16 times gravity, the largest range of accelerometers that robots have.
constexpr double kMaxForceMps2 = 160.0;
/// No base of this class is faster.
constexpr double kMaxWheelsMps = 3.0;

inline bool is_turn_rate(double radps) { return std::abs(radps) <= kMaxTurnRadps; }
inline bool is_force(double mps2) { return std::abs(mps2) <= kMaxForceMps2; }
inline bool is_wheel_speed(double mps) { return std::abs(mps) <= kMaxWheelsMps; }

}  // namespace mtr_core
