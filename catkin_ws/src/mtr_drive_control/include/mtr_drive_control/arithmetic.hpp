/// @file
/// Faster versions of standard functions for the usual arguments, with identical results.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

/// std::remainder(angle_rad, 2 pi): the angle between -pi and pi.
inline double wrapped_rad(double angle_rad) {
  constexpr double kTurnRad = 2.0 * 3.14159265358979323846;
  const double size_rad = std::abs(angle_rad);
  if (size_rad <= 0.5 * kTurnRad) {
    return angle_rad;
  }
  // Up to twice a turn the difference of two doubles has no rounding error.
  return size_rad < 1.5 * kTurnRad ? std::copysign(1.0, angle_rad) * (size_rad - kTurnRad)
                                   : std::remainder(angle_rad, kTurnRad);
}

/// std::floor as an int; the result must be representable.
inline int floored(double value) {
  const int towards_zero = static_cast<int>(value);
  return towards_zero - (value < static_cast<double>(towards_zero) ? 1 : 0);
}

/// std::round as an index; empty if it is negative, at least `size` or NaN.
inline std::optional<std::size_t> rounded_index(double value, std::size_t size) {
  if (!(value > -0.5 && value < static_cast<double>(size))) {
    return std::nullopt;
  }
  const auto below = static_cast<std::size_t>(std::max(value, 0.0));
  const std::size_t index = below + (value - static_cast<double>(below) >= 0.5 ? 1 : 0);
  return index < size ? std::optional<std::size_t>(index) : std::nullopt;
}

/// Compares distance_m(a, b) with a positive limit: the squares decide unless they are equal except for rounding.
template <typename Compare>
bool compares(const Point& a, const Point& b, double limit_m, Compare compare) {
  constexpr double kRounding = 1e-12;
  const double dx = a.x_m - b.x_m;
  const double dy = a.y_m - b.y_m;
  const double square = dx * dx + dy * dy;
  const double limit = limit_m * limit_m;
  return std::abs(square - limit) > kRounding * limit ? compare(square, limit) : compare(distance_m(a, b), limit_m);
}

/// distance_m(a, b) < limit_m
inline bool is_nearer(const Point& a, const Point& b, double limit_m) { return compares(a, b, limit_m, std::less<>()); }

/// distance_m(a, b) <= limit_m
inline bool is_within(const Point& a, const Point& b, double limit_m) {
  return compares(a, b, limit_m, std::less_equal<>());
}

}  // namespace mtr_drive_control
