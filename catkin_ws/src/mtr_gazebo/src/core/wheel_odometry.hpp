/// @file
/// Odometry from the wheel encoders.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace mtr_gazebo {

/// Pose since the start, and mean speed over the last period.
struct OdometryReading {
  double x_m{0.0};
  double y_m{0.0};
  double heading_rad{0.0};
  double linear_mps{0.0};
  double angular_radps{0.0};
};

/// Radius and half track as assumed by the base, and resolution of its encoders.
struct OdometryFigures {
  double believed_radius_m{1.0};
  double believed_half_track_m{1.0};
  double ticks_per_m{1.0};
};

/// Counts whole encoder ticks; the remainder carries over to later periods.
class WheelOdometry {
 public:
  explicit WheelOdometry(const OdometryFigures& figures);

  /// Returns the reading for the wheel angles of each side since the start (mean of a side, in rad), and the time since
  /// the last reading.
  OdometryReading read(double left_rad, double right_rad, double period_s);

 private:
  [[nodiscard]] double ticks(double angle_rad) const;

  OdometryFigures figures_;
  double left_ticks_{0.0};
  double right_ticks_{0.0};
  OdometryReading last_;
};

}  // namespace mtr_gazebo
