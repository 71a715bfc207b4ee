/// @file
/// Surfaces as seen so far, while the robot drives round and maps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Points of key frames in square cells, and surfels made of neighbouring cells. Good enough to track against for one
/// way round the Car; the adjusted map takes its place.
class GrowingMap {
 public:
  void clear();
  void insert(const PoseVector& pose, const ScanPoints& scan);
  bool empty() const { return cells_.empty(); }

  /// Surfels of all cells that more than one beam met; each as its neighbourhood was when a beam met it last.
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

  /// In the order in which they were met first, so that nothing depends on a hash.
  std::vector<Cell> cells_;
  std::unordered_map<std::int64_t, std::size_t> index_;
};

}  // namespace mtr_surfel_map
