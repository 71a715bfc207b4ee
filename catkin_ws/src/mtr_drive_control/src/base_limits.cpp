/// @file
/// Checks of the base's own limits.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/base_limits.hpp"

#include <sstream>
#include <tuple>

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

std::string changed_limit(const BaseLimits& start, const BaseLimits& now, const std::string& name) {
  const std::tuple<const char*, double, double> limits[] = {
      {"/cmd_vel_timeout", start.command_timeout_s, now.command_timeout_s},
      {"/linear/x/max_acceleration", start.linear_acceleration_mps2, now.linear_acceleration_mps2},
      {"/angular/z/max_acceleration", start.angular_acceleration_radps2, now.angular_acceleration_radps2}};
  for (const auto& [limit, before, after] : limits) {
    // NaN differs from everything.
    if (!(before == after)) {
      std::ostringstream text;
      text << "Parameter " << name << limit << " was " << before << " and is " << after << '.';
      return text.str();
    }
  }
  return {};
}

}  // namespace mtr_drive_control
