/// @file
/// What the sensors say and what localization makes of it, as plain types.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "mtr_core/problem.hpp"

namespace mtr_localization {

/// Stamp in ns of the ROS clock.
struct ImuSample {
  std::int64_t stamp_ns;
  /// Gyro's rate about base_link z, counterclockwise.
  double yaw_rate_radps;
  /// About base_link x and y.
  Eigen::Vector2d tilt_rate_radps = Eigen::Vector2d::Zero();
  /// What the accelerometer shows; +9.81 in z when level and at rest. Zero: there is none.
  Eigen::Vector3d force_mps2 = Eigen::Vector3d::Zero();

  /// False when the yaw rate is no number, or one of the numbers is none that a robot's IMU shows.
  bool is_plausible() const;
};

/// Wheel odometry: pose in its own drifting frame, and velocity of base_link as the wheels see it.
struct WheelSample {
  std::int64_t stamp_ns;
  double x_m;
  double y_m;
  double heading_rad;
  double linear_mps;
  double angular_radps;

  /// False when one of the numbers is none, or a speed is one that no base has.
  bool is_plausible() const;

  /// Distance driven since an earlier sample, along the mean heading of the two, negative backwards; in m.
  double distance_since(const WheelSample& earlier) const;
};

/// Fix of a satellite receiver.
struct GnssFix {
  std::int64_t stamp_ns;
  /// Position of the antenna, WGS-84.
  double latitude_rad;
  double longitude_rad;
  /// Horizontal, in the worst direction; 0: the receiver does not say.
  double sigma_m;
  /// The antenna in base_link, m.
  Eigen::Vector2d antenna = Eigen::Vector2d::Zero();
};

/// What the pose rests on.
enum class PoseMode { kDeadReckoning, kMapping, kLocalized, kLost };

/// Pose of base_link in map at the stamp, and its velocity.
struct Estimate {
  std::int64_t stamp_ns = 0;
  bool valid = false;
  PoseMode mode = PoseMode::kDeadReckoning;
  /// The surfaces in view do not hold the pose in every direction.
  bool degenerate = false;
  /// Map that the pose is in, 0: none.
  std::uint32_t map_revision = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  /// Row-major 3x3 of x (m), y (m), heading (rad).
  std::array<double, 9> covariance{};
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  /// Base_link in odom, which never jumps: by wheels and gyro, and by the wheels' own odometry. x, y (m), heading
  /// (rad).
  std::array<double, 3> odom{};
  std::array<double, 3> wheel_odom{};
  /// One sentence when not valid.
  mtr_core::Problem message;
};

}  // namespace mtr_localization
