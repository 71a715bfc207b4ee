/// @file
/// Uses the site map as a reference against a LiDAR without echoes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echo_memory.hpp"

namespace mtr_drive_control {

/// Ground of a map that was seen free.
struct FreeGround {
  Pose map_from_grid;
  double cell_m = 0.0;
  std::size_t width = 0;
  /// Row-major, true where free.
  std::vector<bool> cells;
};

/// Occupied places in the map frame, and the free ground between them.
struct SiteMap {
  std::vector<Point> occupied;
  FreeGround free = {};

  /// Returns true if all cells up to this distance along each axis of the grid were seen free; false outside of the
  /// map.
  bool is_free_around(const Point& place, double distance_m) const;
};

/// Map and the pose of odom in it.
struct LocalizedMap {
  /// Null while the robot has a position but no map.
  std::shared_ptr<const SiteMap> map;
  Pose map_from_odom;
};

/// Compares sweeps with the map until a sweep proves that a mapped surface has disappeared.
class MapWitness {
 public:
  /// Adds the beams of a sweep without an echo from occupied places.
  void observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes, const LocalizedMap& here,
               EmptyBeams& empty);

 private:
  struct Place {
    bool is_gone = false;
    std::optional<std::int64_t> missing_ns;
  };

  void take(const std::shared_ptr<const SiteMap>& map);
  /// Returns true if the sweep contradicts the place.
  bool is_contradicted(Place& place, const View& view, const Bearing& bearing) const;

  std::shared_ptr<const SiteMap> map_;
  std::vector<Place> places_;
};

}  // namespace mtr_drive_control
