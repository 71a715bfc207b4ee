/// @file
/// Reads a diff_drive_controller's parameters.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/ros/base_parameters.hpp"

#include <ros/ros.h>

#include "mtr_core/clock.hpp"

namespace mtr_drive_control {
namespace {

const char* const kHint =
    " Load mtr_description/config/jackal_base.yaml before the base's controller starts, see docs/robot-motion.md.";

/// Parameters in one namespace.
class Reader {
 public:
  explicit Reader(std::string base) : base_(std::move(base)) {}

  double number(const std::string& name) const {
    double value = 0.0;
    if (!ros::param::get(base_ + "/" + name, value)) {
      throw mtr_core::ConfigurationError("Parameter " + base_ + "/" + name +
                                         " is missing; allowed is one that the mast survives.");
    }
    return value;
  }

  bool is_set(const std::string& name) const { return ros::param::param(base_ + "/" + name, false); }

  /// Acceleration of starts and stops in both directions.
  double acceleration(const std::string& axis) const {
    if (!is_set(axis + "/has_acceleration_limits")) {
      throw mtr_core::ConfigurationError("Parameter " + base_ + "/" + axis +
                                         "/has_acceleration_limits is not true; the mast needs them.");
    }
    if (is_set(axis + "/has_jerk_limits")) {
      throw mtr_core::ConfigurationError("Parameter " + base_ + "/" + axis +
                                         "/has_jerk_limits is true; that would delay an emergency stop.");
    }
    const double most = number(axis + "/max_acceleration");
    if (ros::param::param(base_ + "/" + axis + "/min_acceleration", -most) != -most) {
      throw mtr_core::ConfigurationError("Parameter " + base_ + "/" + axis +
                                         "/min_acceleration is given; allowed is the negative max_acceleration.");
    }
    return most;
  }

 private:
  std::string base_;
};

}  // namespace

BaseLimits checked_base(const std::string& controller, const Parameters& parameters) {
  try {
    const Reader reader(controller);
    const BaseLimits limits{reader.number("cmd_vel_timeout"), reader.acceleration("linear/x"),
                            reader.acceleration("angular/z")};
    check(limits, parameters, controller);
    return limits;
  } catch (const mtr_core::ConfigurationError& error) {
    throw mtr_core::ConfigurationError(error.what() + std::string(kHint));
  }
}

std::optional<BaseLimits> limits_of_base(const std::string& controller, const Parameters& parameters) {
  if (mtr_core::is_lockstep() && !ros::param::has(controller)) {
    return std::nullopt;
  }
  return checked_base(controller, parameters);
}

}  // namespace mtr_drive_control
