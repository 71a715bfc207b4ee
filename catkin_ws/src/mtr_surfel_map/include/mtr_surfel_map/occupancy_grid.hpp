/// @file
/// The adjusted map as a grid of free and occupied cells.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Cells as in nav_msgs/OccupancyGrid: row-major, starting at the corner with the smallest x and y.
struct OccupancyGrid {
  static constexpr std::int8_t kUnknown = -1;
  static constexpr std::int8_t kFree = 0;
  static constexpr std::int8_t kOccupied = 100;

  double cell_m = 0.05;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Vector2i size = Eigen::Vector2i::Zero();
  std::vector<std::int8_t> cells;

  /// Returns the cell value at a point (m, in map), or kUnknown outside the grid.
  std::int8_t at(const Eigen::Vector2d& point) const;
};

/// Returns the grid of the map. A cell is occupied if enough beams that reached it ended there, and free if they passed
/// through.
OccupancyGrid occupancy_of(const AdjustedMap& map);

}  // namespace mtr_surfel_map
