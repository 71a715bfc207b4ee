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
#include "mtr_drive_control/collision/echo_memory.hpp"
#include "mtr_drive_control/collision/ground_memory.hpp"
#include "mtr_drive_control/collision/map_witness.hpp"
#include "mtr_drive_control/collision/newcomers.hpp"

namespace mtr_drive_control {

/// Newest readings at a tick; nothing before the first.
struct Sensors {
  std::shared_ptr<const Sweep> front;
  std::shared_ptr<const Sweep> rear;
  std::optional<Motion> motion;
  /// Nothing while the position is unknown or lost.
  std::optional<LocalizedMap> map = std::nullopt;
  /// Yaw rate by the gyro; nothing without an IMU or while it is silent.
  std::optional<double> gyro_radps = std::nullopt;
};

/// Kinds of obstacles by what they may do next.
enum class Kind {
  /// Car, wall, and what has always been in its place: stays where it is.
  kWide,
  /// May be a person or be moved by one, and walk.
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
  /// It came while its place was observed, or the map shows free ground there.
  bool is_possible_person = false;
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

  /// One sentence when the LiDAR that looks where the robot is to drive has returned no echo since the start although
  /// the other one, or the map, shows a surface; else empty.
  mtr_core::Problem distrust(const Velocity& desired) const;

  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  bool watches_rear() const { return watches_rear_; }

  /// True when this ground, in base_link, was seen free not longer ago.
  bool was_free(const Point& point, double max_age_s) const;

  /// True when this place, in base_link, is in the view of a LiDAR.
  bool is_watched(const Point& point) const;

  /// The robot has stood for this time more, as nothing wants to move it, or as a LiDAR shows nothing.
  void rest(std::int64_t duration_ns) { memory_.rest(duration_ns); }

  /// The robot may have been carried: ground that was seen is unknown from now on.
  void forget_ground() {
    ground_ = GroundMemory();
    newcomers_ = Newcomers();
  }

 private:
  struct Lidar {
    LidarWatch watch;
    EchoFinder finder;
    /// What its newest sweep does not measure.
    std::optional<Sector> covered = std::nullopt;
    EmptySector empty = {};
    MapWitness map = {};
    /// It has returned an echo since the start.
    bool has_seen = false;
    /// And one of a surface.
    bool has_seen_surface = false;
    /// One is in its newest sweep.
    bool sees_surface = false;
    std::vector<Echo> echoes = {};
    /// Of each echo.
    std::vector<Kind> kinds = {};
    std::vector<bool> possible_persons = {};
  };

  bool observe(std::size_t index, const Sensors& sensors);
  void look_for_gaps(std::size_t index, const View& view, const Sensors& sensors);
  /// True when what is remembered may be elsewhere by now.
  bool may_have_been_carried(std::int64_t tick_ns, const Sensors& sensors) const;
  void forget_echoes();
  /// Forgets what an interrupted odometry does not place any longer.
  void follow(const Motion& motion);
  void remember_newcomers(const Lidar& lidar, const Sweep& sweep, const Sensors& sensors);
  bool is_possible_person(const Point& in_odom) const;
  void classify();
  mtr_core::Problem blindness_at(std::int64_t tick_ns) const;
  mtr_core::Problem blindness_of(const Lidar& lidar) const;
  void add_obstacle(const Point& point, std::int64_t seen_ns, Kind kind, bool is_possible_person);
  void find_obstacles();

  CollisionParameters parameters_;
  Footprint footprint_;
  bool watches_rear_;
  std::vector<Lidar> lidars_;
  GroundMemory ground_;
  EchoMemory memory_;
  SteadyFrame steady_;
  Newcomers newcomers_;
  bool has_map_ = false;
  /// At the previous tick.
  bool had_position_ = false;
  /// The newest one that was used.
  std::optional<Motion> followed_;
  std::int64_t tick_ns_ = 0;
  /// False before the first word of the odometry; a stale one is no motion.
  bool has_motion_ = false;
  std::optional<Motion> motion_;
  Pose odom_from_base_;
  mtr_core::Problem blindness_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace mtr_drive_control
