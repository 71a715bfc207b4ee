/// @file
/// From a sweep to the echoes that count: neither the robot itself nor rain, and whether they may be a person.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mtr_drive_control/collision/sweep.hpp"
#include "mtr_drive_control/robot_shape.hpp"

namespace mtr_drive_control {

/// One echo in odom.
struct Echo {
  Point point;
  std::int64_t stamp_ns;
  /// Part of a surface wider than a person, which does not walk: Car, wall.
  bool is_wide;
};

/// Motion of the base about a moment, from the wheels' odometry.
struct Motion {
  std::int64_t stamp_ns;
  Pose odom_from_base;
  Velocity velocity;

  Pose at(std::int64_t time_ns) const {
    return odom_from_base.after(velocity, static_cast<double>(time_ns - stamp_ns) * 1e-9);
  }
};

/// Turns the sweeps of one LiDAR into echoes.
///
/// Neighbouring echoes form a cluster. One of few beams counts only when it stays in its place for some sweeps: a
/// raindrop does not, a thin post does; a leg has more beams and counts at once. What is too near to be measured counts
/// where it may be nearest: at the edge of the footprint.
class EchoFinder {
 public:
  /// @param own_view_rad to each side of where the LiDAR points: what nobody else watches
  EchoFinder(const LidarMount& mount, const Footprint& footprint, double own_view_rad)
      : mount_(mount), footprint_(footprint), own_view_rad_(own_view_rad) {}

  /// Echoes of the next sweep nearer than max_range_m.
  std::vector<Echo> find(const Sweep& sweep, const Motion& motion, double max_range_m);

  /// True when a piece of its own view tells nothing of what is there: no measurement, or only something within the
  /// footprint, which is the robot's mast where it is small and a cover where it is not.
  bool is_covered(const Sweep& sweep) const;

  const LidarMount& mount() const { return mount_; }

 private:
  struct Hit {
    std::size_t beam;
    Point in_base;
    double range_m;
    int cluster;
  };
  struct Small {
    Point point;
    int sweeps_seen;
  };

  std::vector<Hit> hits_of(const Sweep& sweep, double max_range_m) const;
  /// Range of what a beam has met outside the footprint; nothing where it has met nothing there.
  std::optional<double> range_of(const Sweep& sweep, std::size_t beam) const;
  int sweeps_seen(const Point& point) const;

  LidarMount mount_;
  Footprint footprint_;
  double own_view_rad_;
  std::vector<Small> small_;
};

}  // namespace mtr_drive_control
