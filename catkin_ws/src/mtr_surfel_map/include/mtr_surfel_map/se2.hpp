/// @file
/// Poses in the plane: x (m), y (m), heading (rad).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Returns the angle wrapped to [-pi, pi].
inline double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * M_PI); }

inline Eigen::Matrix2d rotation(double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

/// Transforms a point from the frame of the pose into the frame in which the pose is given.
inline Eigen::Vector2d transformed(const PoseVector& pose, const Eigen::Vector2d& point) {
  return rotation(pose[2]) * point + pose.head<2>();
}

/// Returns a_from_c = a_from_b * b_from_c.
inline PoseVector compose(const PoseVector& a_from_b, const PoseVector& b_from_c) {
  PoseVector a_from_c;
  a_from_c << transformed(a_from_b, b_from_c.head<2>()), wrapped(a_from_b[2] + b_from_c[2]);
  return a_from_c;
}

/// Returns pose `to` relative to pose `from`; both are given in the same frame.
inline PoseVector relative(const PoseVector& from, const PoseVector& to) {
  PoseVector result;
  result << rotation(from[2]).transpose() * (to.head<2>() - from.head<2>()), wrapped(to[2] - from[2]);
  return result;
}

}  // namespace mtr_surfel_map
