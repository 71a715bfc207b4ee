/// @file
/// Detection of returns that may come from the ground.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_localization {

// Depth below the LiDAR at which a return may be the ground: LiDARs are at least 0.2 m high, and bumps are 3 cm high.
inline constexpr double kNearGroundM = 0.17;
// Margin for the tilt error in sigmas.
inline constexpr double kLeanSigmas = 2.0;

/// Returns true if a return may come from the ground. A beam that points slightly downwards meets the ground far away,
/// and the uncertainty of its height grows with the range.
/// @param rise_m height of the return relative to the LiDAR; negative below it
/// @param slope_sigma 1 sigma of the robot's slope relative to the ground, per metre
inline bool may_be_ground(double rise_m, double range_m, double slope_sigma) {
  return rise_m - kLeanSigmas * slope_sigma * range_m <= -kNearGroundM;
}

}  // namespace mtr_localization
