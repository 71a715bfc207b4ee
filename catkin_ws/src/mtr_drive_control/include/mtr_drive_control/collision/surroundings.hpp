/// @file
/// What the robot knows of the things and the ground around it at a tick.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/collision/collision_parameters.hpp"
#include "mtr_drive_control/collision/ground_memory.hpp"

namespace mtr_drive_control {

/// Newest readings at a tick; nothing before the first.
struct Sensors {
  std::shared_ptr<const Sweep> front;
  std::shared_ptr<const Sweep> rear;
  std::optional<Motion> motion;
};

/// Kinds of obstacles by what they may do next.
enum class Kind {
  /// Car, wall: stays where it is.
  kWide,
  /// May be a person, and walk.
  kThing,
  /// The same, but has been standing for a while.
  kStanding,
  /// Walked out of view; counts for ground that is not watched.
  kLost,
};

/// An echo where it was seen, in the base_link of the present tick.
struct Obstacle {
  Point point;
  double age_s;
  Kind kind;
  /// From the footprint.
  double distance_m;
};

/// Keeps what the newest sweeps tell.
class Surroundings {
 public:
  /// @param shape without a rear LiDAR the ground behind is not watched
  Surroundings(const CollisionParameters& parameters, const RobotShape& shape);

  /// Takes the readings of a tick; to be called once per tick, before the questions below.
  void take(std::int64_t tick_ns, const Sensors& sensors);

  /// One sentence when a sensor that should see does not, else empty.
  const mtr_core::Problem& blindness() const { return blindness_; }
  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  bool watches_rear() const { return watches_rear_; }

  /// True when this ground, in base_link, was seen free within the memory.
  bool was_free(const Point& point) const;

 private:
  struct Lidar {
    LidarWatch watch;
    EchoFinder finder;
    bool is_covered;
    std::vector<Echo> echoes;
    /// Of each echo.
    std::vector<Kind> kinds;
  };

  bool observe(Lidar& lidar, const std::shared_ptr<const Sweep>& sweep);
  void classify();
  mtr_core::Problem blindness_at(std::int64_t tick_ns) const;
  void add_obstacle(const Point& point, std::int64_t seen_ns, Kind kind);
  void find_obstacles();

  CollisionParameters parameters_;
  Footprint footprint_;
  bool watches_rear_;
  std::vector<Lidar> lidars_;
  GroundMemory ground_;
  std::int64_t tick_ns_ = 0;
  /// False before the first word of the odometry; a stale one is no motion.
  bool has_motion_ = false;
  std::optional<Motion> motion_;
  Pose odom_from_base_;
  mtr_core::Problem blindness_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace mtr_drive_control
