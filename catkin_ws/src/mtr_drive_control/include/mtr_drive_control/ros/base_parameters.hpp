/// @file
/// The base's own limits as its controller reads them from the parameter server.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "mtr_drive_control/base_limits.hpp"

namespace mtr_drive_control {

/// Namespace of the parameters in mtr_description/config/jackal_base.yaml.
inline constexpr char kShippedController[] = "/jackal_velocity_controller";

/// The limits of a base's controller; throws mtr_core::ConfigurationError when one is missing, or one that the mast
/// does not survive.
BaseLimits checked_base(const std::string& controller, const Parameters& parameters);

/// The limits of the base; throws mtr_core::ConfigurationError unless its parameters are there and the mast survives
/// them.
///
/// A simulated robot without them has no base of its own, and is not asked for them: there are none.
/// @param controller namespace of a diff_drive_controller's parameters
std::optional<BaseLimits> limits_of_base(const std::string& controller, const Parameters& parameters);

}  // namespace mtr_drive_control
