/// @file
/// Memory of observations of the ground near the robot: a grid in odom that moves with the robot.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "mtr_drive_control/collision/echoes.hpp"

namespace mtr_drive_control {

/// Thing that was seen and has since been neither seen again nor seen to disappear.
struct LostThing {
  /// In odom.
  Point point;
  std::int64_t seen_ns;
  /// It had only recently arrived at its place: a walking person.
  bool was_moving;
};

/// Stores per cell the last times at which it was seen free and occupied.
class GroundMemory {
 public:
  GroundMemory();

  /// Marks the ground under the footprint as free, and 1 cm around it where the robot came to rest.
  ///
  /// Otherwise a robot that has seen nothing behind it could not start: feedback turns it by some mm. Such places are
  /// 0.3 m apart, so that the robot cannot creep by them.
  void stand(const Footprint& footprint, const Motion& motion);

  /// Marks the beams of a sweep as free up to their echo.
  void observe(const Sweep& sweep, const BeamDirections& directions, const View& view);

  /// Adds the counting echoes of the same sweep.
  void remember(const std::vector<Echo>& echoes, const Motion& motion);

  /// Returns true if a wide surface was seen in this place and has not disappeared since.
  bool was_wide(const Point& point) const;

  /// Returns true if a thing has been in this place long enough to count as stationary.
  bool has_stood(const Point& point) const;

  /// Returns true if this ground was seen free within max_age_s, and not seen occupied since.
  bool was_free(const Point& point, std::int64_t now_ns, double max_age_s) const;

  /// Returns things that left the view within max_age_s.
  std::vector<LostThing> lost_things(std::int64_t now_ns, double max_age_s) const;

 private:
  /// Place where the robot came to rest, and the last time near it.
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

  /// The newest is last.
  std::vector<Rest> rests_;
  std::vector<Cell> cells_;
};

}  // namespace mtr_drive_control
