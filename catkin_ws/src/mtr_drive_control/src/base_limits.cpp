/// @file
/// Checks of the base's own limits.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/base_limits.hpp"

#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {

void check(const BaseLimits& base, const Parameters& parameters, const std::string& name) {
  const double least_mps2 = limits_at(parameters, 0.0).emergency_linear_deceleration_mps2;
  const double most_mps2 = kBaseTipShare * static_limit_mps2(parameters, parameters.key_raised_m);
  mtr_core::check_range(name + "/cmd_vel_timeout", base.command_timeout_s, kMinBaseTimeoutS, kMaxBaseTimeoutS, "s");
  mtr_core::check_range(name + "/linear/x/max_acceleration", base.linear_acceleration_mps2, least_mps2, most_mps2,
                        "m/s2");
  mtr_core::check_range(name + "/angular/z/max_acceleration", base.angular_acceleration_radps2,
                        parameters.emergency_angular_deceleration_radps2, kMaxBaseAngularRadps2, "rad/s2");
}

}  // namespace mtr_drive_control
