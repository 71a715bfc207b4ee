/// @file
/// Plain types of sensor samples and estimates.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "mtr_core/problem.hpp"

namespace mtr_localization {

/// IMU sample; stamp in ns of the ROS clock.
struct ImuSample {
  std::int64_t stamp_ns;
  /// Gyro rate about base_link z, counterclockwise.
  double yaw_rate_radps;
  /// Gyro rates about base_link x and y.
  Eigen::Vector2d tilt_rate_radps = Eigen::Vector2d::Zero();
  /// Accelerometer reading; +9.81 in z when level and at rest. Zero without an accelerometer.
  Eigen::Vector3d force_mps2 = Eigen::Vector3d::Zero();

  /// False if the yaw rate is NaN, or a value is outside the range of a robot's IMU.
  bool is_plausible() const;
};

/// Wheel odometry: pose in its own drifting frame, and velocity of base_link from the wheels.
struct WheelSample {
  std::int64_t stamp_ns;
  double x_m;
  double y_m;
  double heading_rad;
  double linear_mps;
  double angular_radps;

  /// False if a value is not finite, or a speed is outside the range of a base.
  bool is_plausible() const;

  /// Returns the distance driven since an earlier sample, along the mean heading of both, negative backwards; in m.
  double distance_since(const WheelSample& earlier) const;
};

/// Fix of a satellite receiver.
struct GnssFix {
  std::int64_t stamp_ns;
  /// Position of the antenna, WGS-84.
  double latitude_rad;
  double longitude_rad;
  /// Horizontal 1 sigma in the worst direction; 0 if the receiver does not report it.
  double sigma_m;
  /// Position of the antenna in base_link, m.
  Eigen::Vector2d antenna = Eigen::Vector2d::Zero();
};

/// Reference of the pose.
enum class PoseMode { kDeadReckoning, kMapping, kLocalized, kLost };

/// Pose of base_link in map at the stamp, and its velocity.
struct Estimate {
  std::int64_t stamp_ns = 0;
  bool valid = false;
  PoseMode mode = PoseMode::kDeadReckoning;
  /// True if the surfaces in view do not constrain the pose in every direction.
  bool degenerate = false;
  /// Revision of the map that the pose is in, 0 for none.
  std::uint32_t map_revision = 0;
  /// Origin of map; poses of another one do not compare.
  std::uint64_t origin_id = 0;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  /// Row-major 3x3 of x (m), y (m), heading (rad).
  std::array<double, 9> covariance{};
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  /// Pose of base_link in odom from wheels and gyro, and in the wheel odometry; neither jumps by corrections. x, y (m),
  /// heading (rad).
  std::array<double, 3> odom{};
  std::array<double, 3> wheel_odom{};
  /// One sentence if not valid.
  mtr_core::Problem message;
};

}  // namespace mtr_localization
