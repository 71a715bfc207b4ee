/// @file
/// Converts a sweep to the relevant echoes: without the robot itself and rain, classified as wide or possible person.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "mtr_drive_control/collision/sector.hpp"
#include "mtr_drive_control/collision/view.hpp"

namespace mtr_drive_control {

/// One echo in odom.
struct Echo {
  Point point;
  std::int64_t stamp_ns;
  /// Part of a surface wider than a person, which does not walk: Car, wall.
  bool is_wide;
  /// Distance from the LiDAR.
  double range_m;
  std::size_t beam;
  /// Visible angle of its cluster.
  double span_rad;
};

/// Converts the sweeps of one LiDAR to echoes.
///
/// Neighbouring echoes form a cluster. A cluster of few beams counts only if it stays in its place for some sweeps: a
/// raindrop does not, a thin post does; a leg has more beams and counts at once. An object closer than the measuring
/// range counts at its closest possible position, the edge of the footprint.
class EchoFinder {
 public:
  /// @param own_view_rad angle to each side of the LiDAR's direction that no other LiDAR covers
  EchoFinder(const LidarMount& mount, const Footprint& footprint, double own_view_rad);

  /// Reads the next sweep; the functions below refer to it.
  void read(const Sweep& sweep);

  /// Returns the sweep's view with the result of each beam.
  View view_of(const Sweep& sweep, const Motion& motion) const;

  /// Returns echoes in the view of the sweep nearer than max_range_m; must be called once per sweep.
  std::vector<Echo> find(const Sweep& sweep, const View& view, double max_range_m);

  /// Returns the widest sector of its own view without a measurement, if it is wider than a leg. Such beams have no
  /// measurement (NaN, zero), or only an echo within the footprint, which is the mast if small and a cover if not, or
  /// are directions that the sweeps no longer contain.
  std::optional<Sector> covered_sector(const Sweep& sweep);

  /// Returns true if a position in base_link is in the view of its sweeps, as far as this view is known.
  bool sees(const Point& point) const;

  const BeamDirections& directions() const { return directions_; }
  double own_view_rad() const { return own_view_rad_; }

 private:
  struct Hit {
    std::size_t beam;
    Point in_base;
    double range_m;
    int cluster;
  };
  struct Small {
    Point point;
    int sweeps_seen;
  };

  std::vector<Hit> hits(double max_range_m) const;
  /// Returns the range of a beam's echo outside the footprint; empty without one.
  std::optional<double> range_of(const Sweep& sweep, std::size_t beam) const;
  int sweeps_seen(const Point& point) const;
  Sector in_base(double low_rad, double high_rad) const;

  LidarMount mount_;
  Footprint footprint_;
  double own_view_rad_;
  BeamDirections directions_;
  /// By beam, from `range_of`.
  std::vector<std::optional<double>> ranges_m_;
  std::vector<Small> small_;
  /// Range of directions, in the LiDAR's frame, of its sweeps so far.
  double lowest_rad_;
  double highest_rad_;
};

}  // namespace mtr_drive_control
