/// @file
/// What was seen of the ground near the robot, and when: a grid in odom that travels with the robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"

namespace mtr_drive_control {

/// A thing that was seen and has been neither seen again nor seen gone.
struct LostThing {
  /// In odom.
  Point point;
  std::int64_t seen_ns;
  /// It had not been in its place for long: a person who walks.
  bool was_moving;
};

/// Remembers per cell when it was last seen free and when something was last seen there.
class GroundMemory {
 public:
  GroundMemory();

  /// The ground under the footprint is free, and so is 1 cm around it where the robot came to rest.
  ///
  /// Without that a robot that has seen nothing behind it could not set off: feedback turns it by some mm. Such places
  /// are 0.3 m apart, so that the robot does not creep on.
  void stand(const Footprint& footprint, const Motion& motion);

  /// Beams of a sweep: free up to their echo.
  void observe(const Sweep& sweep, const BeamDirections& directions, const View& view);

  /// Echoes that count, of the same sweep.
  void remember(const std::vector<Echo>& echoes, const Motion& motion);

  /// True when something wide was seen in this place and has not gone since.
  bool was_wide(const Point& point) const;

  /// True when something has been in this place for so long that it stands.
  bool has_stood(const Point& point) const;

  /// True when this ground was seen free not longer ago, and nothing was seen there since.
  bool was_free(const Point& point, std::int64_t now_ns, double max_age_s) const;

  /// Things that went out of view not longer ago.
  std::vector<LostThing> lost_things(std::int64_t now_ns, double max_age_s) const;

 private:
  /// Where the robot came to rest, and when it was last near that.
  struct Rest {
    Footprint outline;
    Pose odom_from_base;
    std::int64_t last_ns;
  };
  struct Cell {
    int column = 0;
    int row = 0;
    std::int64_t free_ns = 0;
    std::int64_t hit_ns = 0;
    std::int64_t since_ns = 0;
    bool is_wide = false;
  };

  Cell& cell_at(const Point& point);
  const Cell* find(int column, int row) const;
  void see_free(const Point& point, std::int64_t stamp_ns);
  void keep_rest(const Footprint& footprint, const Motion& motion);
  std::int64_t rested_ns(const Point& point) const;

  /// The newest last.
  std::vector<Rest> rests_;
  std::vector<Cell> cells_;
};

}  // namespace mtr_drive_control
