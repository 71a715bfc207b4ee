/// @file
/// Directions of a sweep's beams on the robot, and poses of the robot at their times.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mtr_drive_control/collision/sweep.hpp"
#include "mtr_drive_control/robot_shape.hpp"

namespace mtr_drive_control {

/// Motion of the base at an instant, from the wheels' odometry.
struct Motion {
  std::int64_t stamp_ns;
  Pose odom_from_base;
  Velocity velocity;

  Pose at(std::int64_t time_ns) const {
    return odom_from_base.after(velocity, static_cast<double>(time_ns - stamp_ns) * 1e-9);
  }
};

/// Directions of one LiDAR's beams in base_link; its sweeps share them as long as their angles are equal.
class BeamDirections {
 public:
  explicit BeamDirections(const LidarMount& mount) : mount_(mount) {}

  /// Updates the directions if this sweep has other angles.
  void follow(const Sweep& sweep);

  /// Position in base_link at this range, as LidarMount::in_base.
  Point in_base(double range_m, std::size_t beam) const {
    const Point& direction = directions_[beam];
    return {mount_.x_m + range_m * direction.x_m, mount_.y_m + range_m * direction.y_m};
  }

 private:
  LidarMount mount_;
  double angle_min_rad_ = 0.0;
  double angle_increment_rad_ = 0.0;
  std::vector<Point> directions_;
};

/// Pose of the base at the time of each beam of a sweep.
class BeamPoses {
 public:
  BeamPoses(const Sweep& sweep, const Motion& motion);

  const Pose& at(std::size_t beam) const { return poses_[poses_.size() == 1 ? 0 : beam]; }
  /// Pose at half of the sweep, which is between two beams if their number is odd.
  const Pose& middle() const { return poses_.size() == 1 ? poses_.front() : middle_; }

 private:
  Pose middle_;
  /// A single pose if all are equal.
  std::vector<Pose> poses_;
};

}  // namespace mtr_drive_control
