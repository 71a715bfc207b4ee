/// @file
/// What a localization that is started again goes on with.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "map_names.hpp"

namespace mtr_localization {

/// The last pose that was valid in a map, and where the wheels' own odometry was then.
struct RememberedPose {
  PoseVector pose = PoseVector::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Base_link in the wheels' odometry, which went on meanwhile: x, y (m), heading (rad).
  std::array<double, 3> wheel_odom{};
};

/// A map of before, and where the robot was on it.
struct Memory {
  /// Surfels and range bias; the key frames have no scans.
  AdjustedMap map;
  std::uint64_t map_car_id = 0;
  std::uint32_t revision = 0;
  /// None: the robot may be anywhere on the map, or beside it.
  std::optional<RememberedPose> pose;
};

/// Whether a pose that is valid at stamp_ns is to be kept, when the one of kept_ns was last. Stamps are of a clock that
/// may have been set either way meanwhile.
bool is_due(std::int64_t stamp_ns, std::int64_t kept_ns);

/// Where wheels have led from a remembered pose to where their odometry is now; none when they went farther than they
/// can be trusted, or their odometry began anew.
/// @param seen_turn_rad how the robot turned meanwhile, where the gyro saw it; none: the wheels' turn
std::optional<RememberedPose> led_by_wheels(const RememberedPose& from, const std::array<double, 3>& wheel_odom,
                                            std::optional<double> seen_turn_rad = std::nullopt);

}  // namespace mtr_localization
