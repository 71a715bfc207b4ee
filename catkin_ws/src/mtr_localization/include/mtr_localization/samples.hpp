/// @file
/// What the sensors say and what localization makes of it, as plain types.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace mtr_localization {

/// Gyro's rate about base_link z, counterclockwise; stamp in ns of the ROS clock.
struct ImuSample {
  std::int64_t stamp_ns;
  double yaw_rate_radps;
};

/// Wheel odometry: pose in its own drifting frame, and velocity of base_link as the wheels see it.
struct WheelSample {
  std::int64_t stamp_ns;
  double x_m;
  double y_m;
  double heading_rad;
  double linear_mps;
  double angular_radps;

  bool is_finite() const;

  /// Distance driven since an earlier sample, along the mean heading of the two, negative backwards; in m.
  double distance_since(const WheelSample& earlier) const;
};

/// Pose of base_link in map at the stamp, and its velocity.
struct Estimate {
  std::int64_t stamp_ns = 0;
  bool valid = false;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  /// Row-major 3x3 of x (m), y (m), heading (rad).
  std::array<double, 9> covariance{};
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  /// One sentence when not valid.
  std::string message;
};

}  // namespace mtr_localization
