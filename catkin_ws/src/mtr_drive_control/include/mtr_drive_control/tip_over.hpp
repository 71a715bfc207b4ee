/// @file
/// Accelerations at which the wheels keep their load, by the height of the key on the mast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// The limits that hold with the key at this height above ground: static tip-over limit times its margin.
///
/// A body on wheels tips when acceleration * height of the centre of mass exceeds g * its horizontal distance from the
/// wheels' line. The permitted speed is lowered with the emergency deceleration, so that a stop still ends in time.
Parameters limits_at(const Parameters& parameters, double key_height_m);

}  // namespace mtr_drive_control
