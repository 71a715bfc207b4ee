/// @file
/// The robot's shape from its URDF.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/robot_shape.hpp"

#include "mtr_core/names.hpp"

namespace mtr_drive_control {
namespace {

using mtr_description::check_value;
using mtr_description::Mount;

constexpr double kPi = 3.14159265358979323846;
// A LiDAR sees three quarters of a turn; turned by more, it would not see both sides of what it is there for.
constexpr double kMaxTurnRad = 0.25 * kPi;

Footprint footprint_of(const mtr_description::Footprint& found) {
  check_value("The footprint's front", found.front_m, 0.1, 1.0, "m");
  check_value("The footprint's rear", found.rear_m, 0.1, 1.0, "m");
  check_value("The footprint's half width", found.half_width_m, 0.1, 0.6, "m");
  return {found.front_m, found.rear_m, found.half_width_m};
}

/// @param ahead_rad direction in base_link in which the LiDAR has to look
LidarMount lidar_of(const Mount& mount, double ahead_rad) {
  mtr_description::check_level(mount);
  check_value("The turn of " + mount.frame + (ahead_rad == 0.0 ? " from straight ahead" : " from straight back"),
              std::remainder(mount.yaw_rad - ahead_rad, 2.0 * kPi), -kMaxTurnRad, kMaxTurnRad, "rad");
  return {mount.x_m, mount.y_m, mount.yaw_rad};
}

}  // namespace

RobotShape shape_of(const mtr_description::RobotGeometry& geometry, bool has_rear_lidar) {
  RobotShape shape{footprint_of(geometry.footprint()), lidar_of(geometry.mount(mtr_core::names::kFrontLidar), 0.0),
                   std::nullopt};
  if (has_rear_lidar) {
    shape.rear_lidar = lidar_of(geometry.mount(mtr_core::names::kRearLidar), kPi);
  }
  return shape;
}

}  // namespace mtr_drive_control
