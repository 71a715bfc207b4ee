/// @file
/// Memory of surfaces near the robot that came to their place while it was observed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"
#include "mtr_drive_control/collision/map_witness.hpp"

namespace mtr_drive_control {

/// Range up to which arrivals are observed; half of the grid is larger.
inline constexpr double kNewcomerReachM = 5.7;

/// Pose of the robot in a frame whose heading comes from the gyro, because wheels slip in turns.
class SteadyFrame {
 public:
  /// Continues with the newest odometry and yaw rate.
  /// @return false if the frame restarted: places of the previous one are void
  bool follow(const Motion& motion, const std::optional<double>& gyro_radps);

  /// Position in this frame of a point in odom.
  Point from_odom(const Point& point) const { return pose_.apply(odom_from_base_.undo(point)); }
  /// The newest motion in this frame.
  const Motion& motion() const { return motion_; }

 private:
  std::optional<std::int64_t> stamp_ns_;
  Pose odom_from_base_;
  Pose pose_;
  Motion motion_{};
  double bias_radps_ = 0.0;
};

/// Grid that distinguishes surfaces that have always been in their place from surfaces that came while it was observed.
///
/// A newcomer was seen in three consecutive sweeps on ground that had been seen free, more than a cell away from all
/// earlier surfaces. It remains one until its place is seen free. A surface is unmapped if the map of the site shows
/// free ground in its place and within 0.4 m of it.
class Newcomers {
 public:
  Newcomers() : cells_(static_cast<std::size_t>(kSide * kSide)) {}

  /// Marks the beams of a sweep as free up to shortly before their echo. The motion is in the steady frame.
  void observe(const Sweep& sweep, const BeamDirections& directions, const Motion& motion);

  /// Adds a counting echo of the sweep with this stamp.
  /// @param place in the steady frame, @param in_map empty while the robot is not localized
  void remember(const Point& place, std::int64_t sweep_ns, const SiteMap* map, const std::optional<Point>& in_map);

  /// Returns true if a surface came to this place while it was observed, and remained.
  bool has_come(const Point& place) const;

  /// Returns true for a newcomer, and for a lasting surface where the map shows free ground.
  bool may_be_person(const Point& place) const;

 private:
  static constexpr int kSide = 64;
  enum class State : std::uint8_t { kNone, kArrived, kEstablished, kNewcomer };
  struct Cell {
    int column = 0;
    int row = 0;
    /// First and last time of the current run of free observations, 0 without one.
    std::int64_t free_since_ns = 0;
    std::int64_t free_ns = 0;
    /// First and last sweep of the current surface.
    std::int64_t since_ns = 0;
    std::int64_t sweep_ns = 0;
    /// Number of consecutive sweeps with a surface here or in a neighbouring cell.
    int run = 0;
    State state = State::kNone;
    bool is_unmapped = false;
    /// Map that was compared with the current surface.
    const SiteMap* asked = nullptr;
  };

  Cell& cell_at(int column, int row);
  const Cell* find(int column, int row) const;
  const Cell* find(const Point& place) const;
  void see_free(const Point& place, std::int64_t stamp_ns);
  /// Returns true if this cell and the ground around it had been seen free.
  bool was_free(const Cell& cell, std::int64_t sweep_ns) const;
  static bool is_known_free(const Cell& cell, std::int64_t sweep_ns);
  State state_of_hit(const Cell& cell, std::int64_t sweep_ns) const;
  int run_at(const Cell& cell, std::int64_t sweep_ns) const;
  /// Returns true if a neighbouring cell has this state and was hit since this time.
  bool has_neighbour(const Cell& cell, State state, std::int64_t since_ns) const;

  std::vector<Cell> cells_;
};

}  // namespace mtr_drive_control
