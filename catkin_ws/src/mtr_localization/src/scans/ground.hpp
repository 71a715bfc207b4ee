/// @file
/// Which returns may be of the ground.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_localization {

// What is met so far below the LiDAR may be the ground: LiDARs sit 0.2 m or more above it, and bumps are 3 cm high.
inline constexpr double kNearGroundM = 0.17;
// Errors of the lean up to which a beam may look lower than it seems, in sigmas.
inline constexpr double kLeanSigmas = 2.0;

/// A beam that looks down by a little meets the ground far away, and the farther away the less its height is known.
/// @param rise_m where the beam ends, above the LiDAR's own height; negative below it
/// @param slope_sigma 1 sigma of the robot's slope against the ground, per metre
inline bool may_be_ground(double rise_m, double range_m, double slope_sigma) {
  return rise_m - kLeanSigmas * slope_sigma * range_m <= -kNearGroundM;
}

}  // namespace mtr_localization
