/// @file
/// Shape of the robot for drive control.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "mtr_description/robot_geometry.hpp"
#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Mount of a LiDAR, upright and level, in base_link.
struct LidarMount {
  double x_m;
  double y_m;
  double yaw_rad;

  Point in_base(double range_m, double angle_rad) const {
    return {x_m + range_m * std::cos(yaw_rad + angle_rad), y_m + range_m * std::sin(yaw_rad + angle_rad)};
  }
};

/// Outline and LiDARs of the robot.
struct RobotShape {
  Footprint footprint;
  LidarMount front_lidar;
  /// Empty: the ground behind is not watched.
  std::optional<LidarMount> rear_lidar;
};

/// Returns the shape from the URDF; throws mtr_core::ConfigurationError for an unsupported footprint or LiDAR.
RobotShape shape_of(const mtr_description::RobotGeometry& geometry, bool has_rear_lidar);

/// Throws mtr_core::ConfigurationError if the parameters of the centre of mass, the wheels or the raised key contradict
/// the URDF.
void check_balance(const Parameters& parameters, const mtr_description::RobotGeometry& geometry);

}  // namespace mtr_drive_control
