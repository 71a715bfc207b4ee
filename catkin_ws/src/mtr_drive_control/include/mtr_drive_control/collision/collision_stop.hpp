/// @file
/// Limits a desired velocity such that the robot stops before it touches anything, or a person touches it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/collision/stopping_path.hpp"
#include "mtr_drive_control/collision/surroundings.hpp"

namespace mtr_drive_control {

/// Values of mtr_msgs/DriveStatus.
enum class Zone : std::uint8_t { kClear = 0, kSlowed = 1, kBlocked = 2, kBlind = 3 };

/// Obstacle in the path.
struct Hindrance {
  /// Distance from the footprint, now; NaN for ground that was not seen.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  /// In base_link.
  double bearing_rad = std::numeric_limits<double>::quiet_NaN();
  bool is_unseen_ground = false;
};

/// Result of the collision stop for a desired motion.
struct Assessment {
  Velocity velocity;
  Zone zone = Zone::kClear;
  std::optional<Hindrance> hindrance;
  /// One sentence if it forbids motion, else empty.
  mtr_core::Problem message;
};

/// Desired motion at a tick.
struct DesiredMotion {
  Velocity velocity;
  /// Set by a person with the manual controller, who sees more than the LiDARs.
  bool by_hand = false;
};

/// Second stage of drive control.
///
/// A velocity is safe if the stop from it, along its own circle, ends before the footprint is closer to a wide thing
/// than the gap, and before a possible person could have reached the footprint. It is reduced by the normal
/// deceleration; the emergency deceleration is reserved for suddenly appearing obstacles. After a stop the path must be
/// free for a pause. Near a possible person the robot is slow, unless the base has a contact skirt.
class CollisionStop {
 public:
  CollisionStop(const CollisionParameters& parameters, const RobotShape& shape);

  /// Accepts the readings of a tick; must be called once per tick, first.
  /// @param late_s possible delay of the next decision
  void take(std::int64_t tick_ns, const Sensors& sensors, double late_s) {
    late_s_ = late_s;
    surroundings_.take(tick_ns, sensors);
    rested_ns_ = assessed_ns_ ? std::max<std::int64_t>(0, tick_ns - *assessed_ns_) : 0;
    assessed_ns_ = tick_ns;
  }

  /// Returns the largest part of the desired motion that is safe when stopped at this deceleration.
  Assessment assess(std::int64_t tick_ns, const DesiredMotion& desired, const Deceleration& normal);

  /// Returns true if the velocity is safe when stopped at this deceleration.
  bool permits(const DesiredMotion& desired, const Deceleration& deceleration) const {
    return !hindrance_of(desired, deceleration);
  }

  /// Handles that no source requests motion.
  void rest() { blocked_motion_.reset(); }

  /// Discards the memory of the ground, because the robot may have been carried.
  void forget_ground() { surroundings_.forget_ground(); }

  const mtr_core::Problem& blindness() const { return surroundings_.blindness(); }
  const Footprint& footprint() const { return footprint_; }
  std::vector<PathPoint> stopping_path_of(const Velocity& velocity, const Deceleration& deceleration) const {
    return stopping_path(velocity, deceleration, parameters_.reaction_s + late_s_, footprint_.radius_m());
  }

 private:
  std::optional<Hindrance> hindrance_of(const DesiredMotion& desired, const Deceleration& deceleration) const;
  bool is_backed_by_person(const DesiredMotion& desired) const;
  /// Returns false without a detailed test if it is too far away for any kind of obstacle.
  bool may_be_reached(const Obstacle& obstacle, const std::vector<PathPoint>& path) const;
  bool is_in_reach(const Obstacle& obstacle, const DesiredMotion& desired, const std::vector<PathPoint>& path) const;
  bool gets_nearer_than(double limit_m, const Point& point, const std::vector<PathPoint>& path) const;
  bool is_approached_by_person(const Obstacle& obstacle, const std::vector<PathPoint>& path) const;
  /// Returns ground that the outline would sweep, that no LiDAR sees, and that was not seen free.
  std::optional<Hindrance> unseen_ground(const DesiredMotion& desired, const std::vector<PathPoint>& path) const;
  Hindrance hindrance_at(const Point& point) const;
  DesiredMotion within_sight(const DesiredMotion& desired) const;
  /// Returns the nearest possible person if one was seen in the slow zone recently; null without one.
  const Obstacle* nearest_possible_person() const;
  /// Returns the maximum speed of the outline that keeps the slow zone of a possible person; infinite without one.
  double slow_zone_mps(std::int64_t tick_ns, double deceleration_mps2);
  double safe_share(const DesiredMotion& desired, const Deceleration& normal) const;
  Assessment blocked(std::int64_t tick_ns, const DesiredMotion& desired, const std::optional<Hindrance>& hindrance);
  bool is_pausing(std::int64_t tick_ns) const;

  CollisionParameters parameters_;
  Footprint footprint_;
  std::vector<Point> edge_;
  Surroundings surroundings_;
  double late_s_ = 0.0;
  std::optional<std::int64_t> assessed_ns_;
  /// Time since the previous tick.
  std::int64_t rested_ns_ = 0;
  /// Direction of the motion that was stopped for an obstacle, until the path has been free for the pause.
  std::optional<DesiredMotion> blocked_motion_;
  std::int64_t last_blocked_ns_ = 0;
  /// Last time of a possible person in the slow zone.
  std::optional<std::int64_t> person_near_ns_;
};

/// Returns a problem such as "Blocked by an obstacle 0.6 m ahead.".
mtr_core::Problem problem_of(const Hindrance& hindrance);

}  // namespace mtr_drive_control
