/// @file
/// The robot's shape from its URDF.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/robot_shape.hpp"

#include <cmath>

#include "mtr_core/names.hpp"

namespace mtr_drive_control {
namespace {

using mtr_description::check_value;
using mtr_description::Mount;

constexpr double kPi = 3.14159265358979323846;
// A LiDAR sees three quarters of a turn; with a larger rotation it would not see both sides of its direction.
constexpr double kMaxTurnRad = 0.25 * kPi;

Footprint footprint_of(const mtr_description::Footprint& found) {
  check_value("The footprint's front", found.front_m, 0.1, 1.0, "m");
  check_value("The footprint's rear", found.rear_m, 0.1, 1.0, "m");
  check_value("The footprint's half width", found.half_width_m, 0.1, 0.6, "m");
  return {found.front_m, found.rear_m, found.half_width_m};
}

/// @param ahead_rad required direction of the LiDAR in base_link
LidarMount lidar_of(const Mount& mount, double ahead_rad) {
  mtr_description::check_level(mount);
  check_value("The turn of " + mount.frame + (ahead_rad == 0.0 ? " from straight ahead" : " from straight back"),
              std::remainder(mount.yaw_rad - ahead_rad, 2.0 * kPi), -kMaxTurnRad, kMaxTurnRad, "rad");
  return {mount.x_m, mount.y_m, mount.yaw_rad};
}

// Accuracy of measured lengths and weighed masses; the tip-over limit changes by at most 4 %.
constexpr double kAgreementM = 0.005;

/// Requires that the parameter matches the URDF within the tolerance.
void check_agreement(const std::string& name, double value, double described, const std::string& unit) {
  const double low = described - kAgreementM;
  const double high = described + kAgreementM;
  if (!(value >= low && value <= high)) {
    throw mtr_core::ConfigurationError("Parameter " + name + " is " + mtr_core::with_unit(value, unit) +
                                       "; allowed by the robot_description is " +
                                       mtr_core::range_text(low, high, unit) + ".");
  }
}

}  // namespace

void check_balance(const Parameters& parameters, const mtr_description::RobotGeometry& geometry) {
  const mtr_description::KeyMount key = geometry.key();
  const mtr_description::CentreOfMass low = geometry.centre_of_mass(0.0);
  const double raised_m = geometry.centre_of_mass(key.lift_travel_m).height_m - low.height_m;
  const double rise = raised_m / key.lift_travel_m;
  const mtr_description::Wheels wheels = geometry.wheels();
  check_agreement("centre_of_mass_m", parameters.centre_of_mass_m, low.height_m - rise * key.min_height_m, "m");
  check_agreement("centre_of_mass_rise", parameters.centre_of_mass_rise, rise, "(ratio)");
  check_agreement("tip_lever_along_m", parameters.tip_lever_along_m, 0.5 * wheels.base_m - std::abs(low.x_m), "m");
  check_agreement("tip_lever_across_m", parameters.tip_lever_across_m, 0.5 * wheels.track_m - std::abs(low.y_m), "m");
  check_agreement("key_raised_m", parameters.key_raised_m, key.max_height_m(), "m");
}

RobotShape shape_of(const mtr_description::RobotGeometry& geometry, bool has_rear_lidar) {
  RobotShape shape{footprint_of(geometry.footprint()), lidar_of(geometry.mount(mtr_core::names::kFrontLidar), 0.0),
                   std::nullopt};
  if (has_rear_lidar) {
    shape.rear_lidar = lidar_of(geometry.mount(mtr_core::names::kRearLidar), kPi);
  }
  return shape;
}

}  // namespace mtr_drive_control
