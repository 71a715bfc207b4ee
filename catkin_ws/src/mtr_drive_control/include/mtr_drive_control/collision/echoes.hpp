/// @file
/// From a sweep to the echoes that count: neither the robot itself nor rain, and whether they may be a person.
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
  /// From the LiDAR.
  double range_m;
  std::size_t beam;
  /// Angle over which its cluster is seen.
  double span_rad;
};

/// Turns the sweeps of one LiDAR into echoes.
///
/// Neighbouring echoes form a cluster. One of few beams counts only when it stays in its place for some sweeps: a
/// raindrop does not, a thin post does; a leg has more beams and counts at once. What is too near to be measured counts
/// where it may be nearest: at the edge of the footprint.
class EchoFinder {
 public:
  /// @param own_view_rad to each side of where the LiDAR points: what nobody else watches
  EchoFinder(const LidarMount& mount, const Footprint& footprint, double own_view_rad);

  /// Reads the next sweep; the questions below are about it.
  void read(const Sweep& sweep);

  /// What each of its beams returned.
  View view_of(const Sweep& sweep, const Motion& motion) const;

  /// Echoes in the view of the sweep nearer than max_range_m; to be called once for a sweep.
  std::vector<Echo> find(const Sweep& sweep, const View& view, double max_range_m);

  /// Widest piece of its own view that measures nothing, when it is wider than a leg: no measurement (NaN, zero), only
  /// something within the footprint, which is the mast where it is small and a cover where it is not, or directions
  /// that its sweeps do not contain any longer.
  std::optional<Sector> covered_sector(const Sweep& sweep);

  /// True when a place in base_link is in the view of its sweeps, as far as they are known to be seen.
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
  /// Range of what a beam has met outside the footprint; nothing where it has met nothing there.
  std::optional<double> range_of(const Sweep& sweep, std::size_t beam) const;
  int sweeps_seen(const Point& point) const;
  Sector in_base(double low_rad, double high_rad) const;

  LidarMount mount_;
  Footprint footprint_;
  double own_view_rad_;
  BeamDirections directions_;
  /// By beam, as by `range_of`.
  std::vector<std::optional<double>> ranges_m_;
  std::vector<Small> small_;
  /// Directions in the LiDAR's frame that its sweeps have contained.
  double lowest_rad_;
  double highest_rad_;
};

}  // namespace mtr_drive_control
