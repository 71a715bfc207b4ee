/// @file
/// The map of the site as a witness against a LiDAR that returns nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mtr_drive_control/collision/echo_memory.hpp"

namespace mtr_drive_control {

/// Occupied places, in map.
struct SiteMap {
  std::vector<Point> occupied;
};

/// A map and where odom lies in it.
struct LocalizedMap {
  /// Null while the robot has a position but no map.
  std::shared_ptr<const SiteMap> map;
  Pose map_from_odom;
};

/// Compares sweeps with the map until a sweep proves that something has gone since it was made.
class MapWitness {
 public:
  /// Adds the beams of a sweep that returned nothing from occupied places.
  void observe(const View& view, const Witness& lidar, const std::vector<Echo>& echoes, const LocalizedMap& here,
               EmptyBeams& empty);

 private:
  struct Place {
    bool is_gone = false;
    std::optional<std::int64_t> missing_ns;
  };

  void take(const std::shared_ptr<const SiteMap>& map);
  /// True when the sweep contradicts the place.
  bool is_contradicted(Place& place, const View& view, const Bearing& bearing) const;

  std::shared_ptr<const SiteMap> map_;
  std::vector<Place> places_;
};

}  // namespace mtr_drive_control
