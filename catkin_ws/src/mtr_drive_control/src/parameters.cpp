/// @file
/// Checks of drive control's parameters.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/parameters.hpp"

#include "mtr_drive_control/collision/collision_parameters.hpp"

namespace mtr_drive_control {
namespace {

// Over less than half a degree a reduction would be a stop.
constexpr double kLeastTiltRangeRad = 0.0087;

}  // namespace

void check(const Parameters& parameters) {
  for (const Row& row : kRows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
  mtr_core::check_range("emergency_linear_deceleration_mps2", parameters.emergency_linear_deceleration_mps2,
                        parameters.max_linear_mps / kStopWithinS, 10.0, "m/s2");
  mtr_core::check_range("emergency_angular_deceleration_radps2", parameters.emergency_angular_deceleration_radps2,
                        parameters.max_angular_radps / kStopWithinS, 20.0, "rad/s2");
  mtr_core::check_range("tilt_stop_rad", parameters.tilt_stop_rad, parameters.tilt_slow_rad + kLeastTiltRangeRad,
                        0.1745, "rad");
}

void check(const CollisionParameters& parameters) {
  for (const CollisionRow& row : kCollisionRows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

}  // namespace mtr_drive_control
