/// @file
/// State with which a restarted localization resumes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "map_names.hpp"

namespace mtr_localization {

/// Last valid pose in a map, with the wheel odometry at that time.
struct RememberedPose {
  PoseVector pose = PoseVector::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  /// Pose of base_link in the wheel odometry, which continues during the restart: x, y (m), heading (rad).
  std::array<double, 3> wheel_odom{};
  /// Origin of the map that the pose is in, 0: unknown.
  std::uint64_t origin_id = 0;
};

/// Previous map, and the pose of the robot on it.
struct Memory {
  /// Surfels and range bias; the key frames have no scans.
  AdjustedMap map;
  std::uint64_t map_car_id = 0;
  std::uint32_t revision = 0;
  /// None if the robot may be anywhere on the map or outside of it.
  std::optional<RememberedPose> pose;
};

/// Returns true if a pose valid at stamp_ns must be stored, after one was stored at kept_ns. The clock of the stamps
/// may have been set forward or back in between.
bool is_due(std::int64_t stamp_ns, std::int64_t kept_ns);

/// Propagates a remembered pose with wheel odometry. Returns nothing if the motion is too large to be trusted, or the
/// odometry was reset.
/// @param seen_turn_rad turn measured by the gyro in between; without it, the turn of the wheels is used
std::optional<RememberedPose> led_by_wheels(const RememberedPose& from, const std::array<double, 3>& wheel_odom,
                                            std::optional<double> seen_turn_rad = std::nullopt);

}  // namespace mtr_localization
