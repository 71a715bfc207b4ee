/// @file
/// Incremental map of the surfaces seen so far during the mapping drive.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Points of key frames in square cells, and surfels fitted to neighbouring cells. It is accurate enough for tracking
/// during one drive round the Car; the adjusted map replaces it.
class GrowingMap {
 public:
  void clear();
  void insert(const PoseVector& pose, const ScanPoints& scan);
  bool empty() const { return cells_.empty(); }

  /// Returns the surfels of all cells with more than one hit. Each surfel is fitted when a beam hits its cell, so it
  /// may lack later returns of neighbouring cells.
  std::vector<Surfel> surfels() const;

 private:
  struct Cell {
    Eigen::Vector2i place;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    Eigen::Vector2d seen_along = Eigen::Vector2d::Zero();
    double lowest_rise_m = 0.0;
    double highest_rise_m = 0.0;
    int hits = 0;
    Surfel surfel{};
  };

  const Cell* cell_at(int x, int y) const;
  std::size_t index_at(const Eigen::Vector2d& position);
  Surfel surfel_of(const Cell& cell) const;

  /// Cells in the order of their first hit, so that results do not depend on hash order.
  std::vector<Cell> cells_;
  std::unordered_map<std::int64_t, std::size_t> index_;
};

}  // namespace mtr_surfel_map
