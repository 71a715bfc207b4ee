/// @file
/// Counts the beams that end in and pass through each cell.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

#include "cell_walk.hpp"
#include "mtr_surfel_map/se2.hpp"

namespace mtr_surfel_map {
namespace {

constexpr double kMarginM = 0.5;
// Longer ranges are ignored: a stray return far away must not exhaust the memory.
constexpr double kMaxM = 60.0;
constexpr int kMinHits = 2;
// A stationary surface is narrower than its cell, so some beams pass through the cell without a hit.
constexpr double kHitShare = 0.25;

/// Beam from the LiDAR to its return, in map.
struct Beam {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};

std::vector<Beam> beams_of(const AdjustedMap& map) {
  std::vector<Beam> beams;
  for (const KeyFrame& frame : map.key_frames) {
    for (const ScanPoint& point : frame.scan.points) {
      if (point.range_m < kMaxM) {
        beams.push_back({transformed(frame.pose, point.position - point.range_m * point.direction),
                         transformed(frame.pose, map.range_bias.corrected(point))});
      }
    }
  }
  return beams;
}

OccupancyGrid grid_over(const std::vector<Beam>& beams) {
  OccupancyGrid grid;
  if (beams.empty()) {
    return grid;
  }
  Eigen::Vector2d low = beams.front().from;
  Eigen::Vector2d high = low;
  for (const Beam& beam : beams) {
    low = low.cwiseMin(beam.from).cwiseMin(beam.to);
    high = high.cwiseMax(beam.from).cwiseMax(beam.to);
  }
  grid.origin = (low / grid.cell_m).array().floor() * grid.cell_m - kMarginM;
  grid.size = ((high - grid.origin).array() / grid.cell_m + kMarginM / grid.cell_m).ceil().cast<int>();
  grid.cells.assign(static_cast<std::size_t>(grid.size.x()) * grid.size.y(), OccupancyGrid::kUnknown);
  return grid;
}

}  // namespace

std::int8_t OccupancyGrid::at(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d place = (point - origin) / cell_m;
  if ((place.array() < 0.0).any() || (place.array() >= size.array().cast<double>()).any()) {
    return kUnknown;
  }
  const Eigen::Vector2i cell = place.array().floor().cast<int>();
  return cells[static_cast<std::size_t>(cell.y()) * size.x() + cell.x()];
}

OccupancyGrid occupancy_of(const AdjustedMap& map) {
  const std::vector<Beam> beams = beams_of(map);
  OccupancyGrid grid = grid_over(beams);
  std::vector<int> hits(grid.cells.size(), 0);
  std::vector<int> visits(grid.cells.size(), 0);
  for (const Beam& beam : beams) {
    std::size_t last = 0;
    walk_cells((beam.from - grid.origin) / grid.cell_m, (beam.to - grid.origin) / grid.cell_m,
               [&](const Eigen::Vector2i& cell) {
                 last = static_cast<std::size_t>(cell.y()) * grid.size.x() + cell.x();
                 ++visits[last];
               });
    ++hits[last];
  }
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    if (hits[i] >= kMinHits && hits[i] >= kHitShare * visits[i]) {
      grid.cells[i] = OccupancyGrid::kOccupied;
    } else if (visits[i] > hits[i]) {
      grid.cells[i] = OccupancyGrid::kFree;
    }
  }
  return grid;
}

}  // namespace mtr_surfel_map
