/// @file
/// Sector of a LiDAR's view.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_drive_control {

/// A wider sector without a measurement may hide a person: at 1 m a leg has this width, and two legs are farther apart.
inline constexpr double kLegRad = 0.175;

/// Directions in base_link, counterclockwise from the first to the last.
struct Sector {
  double from_rad;
  double to_rad;
};

}  // namespace mtr_drive_control
