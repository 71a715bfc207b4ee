// SPDX-License-Identifier: Apache-2.0
#include "core/wheel_odometry.hpp"

#include <cmath>

namespace mtr_gazebo {

WheelOdometry::WheelOdometry(const OdometryFigures& figures) : figures_(figures) {}

OdometryReading WheelOdometry::read(double left_rad, double right_rad, double period_s) {
  const double left_ticks = ticks(left_rad);
  const double right_ticks = ticks(right_rad);
  const double left_m = (left_ticks - left_ticks_) / figures_.ticks_per_m;
  const double right_m = (right_ticks - right_ticks_) / figures_.ticks_per_m;
  left_ticks_ = left_ticks;
  right_ticks_ = right_ticks;
  const double distance_m = 0.5 * (left_m + right_m);
  const double turn_rad = (right_m - left_m) / (2.0 * figures_.believed_half_track_m);
  const double middle_rad = last_.heading_rad + 0.5 * turn_rad;
  last_ = {last_.x_m + distance_m * std::cos(middle_rad), last_.y_m + distance_m * std::sin(middle_rad),
           last_.heading_rad + turn_rad, distance_m / period_s, turn_rad / period_s};
  return last_;
}

double WheelOdometry::ticks(double angle_rad) const {
  return std::floor(angle_rad * figures_.believed_radius_m * figures_.ticks_per_m);
}

}  // namespace mtr_gazebo
