/// @file
/// One sweep as seen from the moving robot: the result of each beam, and the position of points of odom in it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/beams.hpp"

namespace mtr_drive_control {

/// Direction and distance of a point from the LiDAR at the time of its beam.
struct Bearing {
  std::size_t beam;
  double range_m;
};

/// Relation of a sweep to a point at which a surface was seen.
enum class Evidence {
  /// Outside the field of view.
  kOutOfView,
  /// A beam returned from this place.
  kConfirmed,
  /// The beam returned from behind it: it has gone.
  kSeenThrough,
  /// The beam returned from something nearer.
  kHidden,
  /// The beam returned no echo.
  kNothing,
};

/// Sweep with the motion of the robot during it.
class View {
 public:
  /// @param returned_m by beam: range of its echo, 0 for the robot itself, +inf or NaN without an echo
  View(const Sweep& sweep, const LidarMount& mount, const Motion& motion, std::vector<double> returned_m);

  /// Position of a point of odom in the sweep; empty outside the field of view.
  std::optional<Bearing> bearing_of(const Point& point) const;

  /// Evidence of the sweep on a surface at this place.
  /// @param tolerance_m of its range, @param tolerance_rad of its direction
  Evidence evidence_at(const Bearing& bearing, double tolerance_m, double tolerance_rad) const;

  /// True if the beam returned no echo.
  bool is_empty(std::size_t beam) const { return !(returned_m_[beam] < kInfinity); }
  std::size_t beams() const { return returned_m_.size(); }
  double step_rad() const { return std::abs(angle_increment_rad_); }
  /// Direction of a beam in the LiDAR's frame.
  double angle_rad(std::size_t beam) const;
  /// Direction of a beam in base_link.
  double angle_in_base_rad(std::size_t beam) const;
  /// Position of the robot in odom.
  Point position() const { return position_; }
  /// Pose of the robot in odom at the time of a beam.
  const Pose& pose_at(std::size_t beam) const { return poses_.at(beam); }
  std::int64_t stamp_ns() const { return stamp_ns_; }
  double range_min_m() const { return range_min_m_; }
  double range_max_m() const { return range_max_m_; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  std::optional<std::size_t> beam_at(double angle_rad) const;

  std::int64_t stamp_ns_;
  double angle_min_rad_;
  double angle_increment_rad_;
  double range_min_m_;
  double range_max_m_;
  LidarMount mount_;
  Point position_;
  BeamPoses poses_;
  std::vector<double> returned_m_;
};

}  // namespace mtr_drive_control
