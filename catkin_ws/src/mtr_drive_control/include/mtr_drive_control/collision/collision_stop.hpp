/// @file
/// How much of a wanted velocity is safe: the robot must stop before it touches anything, or anybody touches it.
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

/// Numbers of mtr_msgs/DriveStatus.
enum class Zone : std::uint8_t { kClear = 0, kSlowed = 1, kBlocked = 2, kBlind = 3 };

/// What is in the way.
struct Hindrance {
  /// From the footprint to it, now; NaN for ground that was not seen.
  double distance_m = std::numeric_limits<double>::quiet_NaN();
  /// In base_link.
  double bearing_rad = std::numeric_limits<double>::quiet_NaN();
  bool is_unseen_ground = false;
};

/// What the collision stop makes of a desired motion.
struct Assessment {
  Velocity velocity;
  Zone zone = Zone::kClear;
  std::optional<Hindrance> hindrance;
  /// One sentence when it forbids motion, else empty.
  mtr_core::Problem message;
};

/// What is wanted at a tick.
struct DesiredMotion {
  Velocity velocity;
  /// By a person who holds the manual controller and sees what no LiDAR sees.
  bool by_hand = false;
};

/// Second stage of drive control.
///
/// A velocity is safe when the stop from it, along its own circle, ends before the footprint comes nearer to a wide
/// thing than the gap, and before anything that may be a person could have walked up to the footprint. It is reduced
/// by the normal deceleration; the emergency one is left for what appears suddenly. After a stop the way must be free
/// for a pause. Near a possible person it is slow, unless the base has a contact skirt.
class CollisionStop {
 public:
  CollisionStop(const CollisionParameters& parameters, const RobotShape& shape);

  /// Takes the readings of a tick; to be called once per tick, first.
  /// @param late_s so much later than usual the next decision may come
  void take(std::int64_t tick_ns, const Sensors& sensors, double late_s) {
    late_s_ = late_s;
    surroundings_.take(tick_ns, sensors);
    rested_ns_ = assessed_ns_ ? std::max<std::int64_t>(0, tick_ns - *assessed_ns_) : 0;
    assessed_ns_ = tick_ns;
  }

  /// Largest part of the desired motion that is safe when stopped at this deceleration.
  Assessment assess(std::int64_t tick_ns, const DesiredMotion& desired, const Deceleration& normal);

  /// True when the velocity is safe when stopped at this deceleration.
  bool permits(const DesiredMotion& desired, const Deceleration& deceleration) const {
    return !hindrance_of(desired, deceleration);
  }

  /// Nobody wants to move any more.
  void rest() { blocked_motion_.reset(); }

  /// The robot may have been carried: it knows no ground.
  void forget_ground() { surroundings_.forget_ground(); }

  const mtr_core::Problem& blindness() const { return surroundings_.blindness(); }
  const Footprint& footprint() const { return footprint_; }
  std::vector<PathPoint> stopping_path_of(const Velocity& velocity, const Deceleration& deceleration) const {
    return stopping_path(velocity, deceleration, parameters_.reaction_s + late_s_, footprint_.radius_m());
  }

 private:
  std::optional<Hindrance> hindrance_of(const DesiredMotion& desired, const Deceleration& deceleration) const;
  bool is_backed_by_person(const DesiredMotion& desired) const;
  /// False spares a closer test: it is too far away for any kind of obstacle.
  bool may_be_reached(const Obstacle& obstacle, const std::vector<PathPoint>& path) const;
  bool is_in_reach(const Obstacle& obstacle, const DesiredMotion& desired, const std::vector<PathPoint>& path) const;
  bool gets_nearer_than(double limit_m, const Point& point, const std::vector<PathPoint>& path) const;
  bool is_approached_by_person(const Obstacle& obstacle, const std::vector<PathPoint>& path) const;
  /// Ground that the outline would sweep, that no LiDAR sees, and that was not seen free.
  std::optional<Hindrance> unseen_ground(const DesiredMotion& desired, const std::vector<PathPoint>& path) const;
  Hindrance hindrance_at(const Point& point) const;
  DesiredMotion within_sight(const DesiredMotion& desired) const;
  /// The nearest possible person, while one was seen in the slow zone a moment ago; null without one.
  const Obstacle* nearest_possible_person() const;
  /// Fastest motion of the outline that keeps the slow zone of a possible person; infinite without one.
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
  /// Since the tick before.
  std::int64_t rested_ns_ = 0;
  /// Direction of the motion that was stopped for an obstacle, until the way has been free for the pause.
  std::optional<DesiredMotion> blocked_motion_;
  std::int64_t last_blocked_ns_ = 0;
  /// When a possible person was in the slow zone.
  std::optional<std::int64_t> person_near_ns_;
};

/// "Blocked by an obstacle 0.6 m ahead." and the like.
mtr_core::Problem problem_of(const Hindrance& hindrance);

}  // namespace mtr_drive_control
