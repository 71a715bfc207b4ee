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

/// Returns the limits of a base's controller; throws mtr_core::ConfigurationError if one is missing, or if the mast
/// does not survive it.
BaseLimits checked_base(const std::string& controller, const Parameters& parameters);

/// Returns the limits of the base; throws mtr_core::ConfigurationError unless its parameters exist and the mast
/// survives them.
///
/// A simulated robot without them has no base of its own: the result is then empty.
/// @param controller namespace of a diff_drive_controller's parameters
std::optional<BaseLimits> limits_of_base(const std::string& controller, const Parameters& parameters);

}  // namespace mtr_drive_control
