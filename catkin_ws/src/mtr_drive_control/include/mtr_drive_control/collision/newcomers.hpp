/// @file
/// Memory of which surfaces near the robot came to their place while their place was observed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"
#include "mtr_drive_control/collision/map_witness.hpp"

namespace mtr_drive_control {

/// What comes is observed up to this range; half of the grid is larger.
inline constexpr double kNewcomerReachM = 5.7;

/// Pose of the robot in a frame whose heading comes from the gyro, because wheels slip in turns.
class SteadyFrame {
 public:
  /// Continues with the newest odometry and yaw rate.
  /// @return false when the frame began again: places of the previous one are void
  bool follow(const Motion& motion, const std::optional<double>& gyro_radps);

  /// Place in this frame of a point in odom.
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

/// Grid that tells surfaces that have always been in their place from those that came while it was observed.
///
/// A newcomer was seen in three sweeps in a row on ground that had been seen free, farther than a cell from everything
/// that was there before. It remains one until its place is seen free. A surface is unmapped when the map of the site
/// shows free ground in its place and within 0.4 m of it.
class Newcomers {
 public:
  Newcomers() : cells_(static_cast<std::size_t>(kSide * kSide)) {}

  /// Beams of a sweep: free up to shortly before their echo. The motion is that of the steady frame.
  void observe(const Sweep& sweep, const BeamDirections& directions, const Motion& motion);

  /// One echo that counts, of the sweep with this stamp.
  /// @param place in the steady frame, @param in_map nothing while the robot is not localized
  void remember(const Point& place, std::int64_t sweep_ns, const SiteMap* map, const std::optional<Point>& in_map);

  /// True when something came to this place while it was observed, and remained.
  bool has_come(const Point& place) const;

  /// True for what came, and for what remains at a place where the map shows free ground.
  bool may_be_person(const Point& place) const;

 private:
  static constexpr int kSide = 64;
  enum class State : std::uint8_t { kNone, kArrived, kEstablished, kNewcomer };
  struct Cell {
    int column = 0;
    int row = 0;
    /// First and last time of the present run of free sights, 0 without one.
    std::int64_t free_since_ns = 0;
    std::int64_t free_ns = 0;
    /// First and last sweep of the present surface.
    std::int64_t since_ns = 0;
    std::int64_t sweep_ns = 0;
    /// Sweeps in a row in which a surface was here or in a neighbouring cell.
    int run = 0;
    State state = State::kNone;
    bool is_unmapped = false;
    /// Map that was asked for the present surface.
    const SiteMap* asked = nullptr;
  };

  Cell& cell_at(int column, int row);
  const Cell* find(int column, int row) const;
  const Cell* find(const Point& place) const;
  void see_free(const Point& place, std::int64_t stamp_ns);
  /// True when this cell and the ground around it had been seen free.
  bool was_free(const Cell& cell, std::int64_t sweep_ns) const;
  static bool is_known_free(const Cell& cell, std::int64_t sweep_ns);
  State state_of_hit(const Cell& cell, std::int64_t sweep_ns) const;
  int run_at(const Cell& cell, std::int64_t sweep_ns) const;
  /// True when a cell of this state is next to the cell, and was hit since this time.
  bool has_neighbour(const Cell& cell, State state, std::int64_t since_ns) const;

  std::vector<Cell> cells_;
};

}  // namespace mtr_drive_control
