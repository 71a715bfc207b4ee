/// @file
/// Known obstacles and ground around the robot at a tick.
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

/// Newest readings at a tick; empty before the first.
struct Sensors {
  std::shared_ptr<const Sweep> front;
  std::shared_ptr<const Sweep> rear;
  std::optional<Motion> motion;
  /// Empty while the position is unknown or lost.
  std::optional<LocalizedMap> map = std::nullopt;
  /// Yaw rate of the gyro; empty without an IMU or while it is silent.
  std::optional<double> gyro_radps = std::nullopt;
};

/// Kinds of obstacles by their possible behaviour.
enum class Kind {
  /// Car, wall, and surfaces that have always been in their place: static.
  kWide,
  /// May be a person or be moved by one, and walk.
  kThing,
  /// The same, but stationary for some time.
  kStanding,
  /// Walked out of view; counts for ground that is not watched.
  kLost,
};

/// Echo at its observed position, in the base_link of the current tick.
struct Obstacle {
  Point point;
  double age_s;
  Kind kind;
  /// Distance from the footprint.
  double distance_m;
  /// It came while its place was observed, or the map shows free ground there.
  bool is_possible_person = false;
};

/// State of the surroundings from the newest sweeps.
class Surroundings {
 public:
  /// @param shape without a rear LiDAR the ground behind is not watched
  Surroundings(const CollisionParameters& parameters, const RobotShape& shape);

  /// Accepts the readings of a tick; must be called once per tick, before the functions below.
  void take(std::int64_t tick_ns, const Sensors& sensors);

  /// One sentence if a required sensor is blind, else empty.
  const mtr_core::Problem& blindness() const { return blindness_; }

  /// One sentence if the LiDAR in the direction of motion has returned no echo since the start, although the other one
  /// or the map shows a surface; else empty.
  mtr_core::Problem distrust(const Velocity& desired) const;

  const std::vector<Obstacle>& obstacles() const { return obstacles_; }
  bool watches_rear() const { return watches_rear_; }

  /// Returns true if this ground, in base_link, was seen free within max_age_s.
  bool was_free(const Point& point, double max_age_s) const;

  /// Returns true if this place, in base_link, is in the view of a LiDAR.
  bool is_watched(const Point& point) const;

  /// Adds a time of standstill without a motion request, or because of a LiDAR without echoes.
  void rest(std::int64_t duration_ns) { memory_.rest(duration_ns); }

  /// Discards the memory of the ground, because the robot may have been carried.
  void forget_ground() {
    ground_ = GroundMemory();
    newcomers_ = Newcomers();
  }

 private:
  struct Lidar {
    LidarWatch watch;
    EchoFinder finder;
    /// Sector without measurements in its newest sweep.
    std::optional<Sector> covered = std::nullopt;
    EmptySector empty = {};
    MapWitness map = {};
    /// It has returned an echo since the start.
    bool has_seen = false;
    /// It has returned an echo of a surface.
    bool has_seen_surface = false;
    /// Its newest sweep contains a surface.
    bool sees_surface = false;
    std::vector<Echo> echoes = {};
    /// Kind of each echo.
    std::vector<Kind> kinds = {};
    std::vector<bool> possible_persons = {};
  };

  bool observe(std::size_t index, const Sensors& sensors);
  void look_for_gaps(std::size_t index, const View& view, const Sensors& sensors);
  /// Returns true if remembered surfaces may have shifted.
  bool may_have_been_carried(std::int64_t tick_ns, const Sensors& sensors) const;
  void forget_echoes();
  /// Discards memory that an interrupted odometry can no longer locate.
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
  /// State at the previous tick.
  bool had_position_ = false;
  /// Newest motion that was used.
  std::optional<Motion> followed_;
  std::int64_t tick_ns_ = 0;
  /// False before the first odometry; stale odometry does not count as motion.
  bool has_motion_ = false;
  std::optional<Motion> motion_;
  Pose odom_from_base_;
  mtr_core::Problem blindness_;
  std::vector<Obstacle> obstacles_;
};

}  // namespace mtr_drive_control
