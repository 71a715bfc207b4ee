/// @file
/// Surface elements with fast lookup of the nearest one and of those that a line of sight crosses.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Surface element matched to a point.
struct SurfelMatch {
  const Surfel* surfel;
  /// Signed distance of the point from the surface, positive on the side of the normal.
  double distance_along_normal_m;
};

/// Fixed set of surfels with a grid index that lists the surfels of each cell.
class SurfelMap {
 public:
  SurfelMap() = default;
  explicit SurfelMap(std::vector<Surfel> surfels);

  const std::vector<Surfel>& surfels() const { return surfels_; }

  /// Returns the surfel nearest to a point along the surfel normal, or nothing. A match must face the viewer, cover the
  /// point along its length, and be at most max_distance_m away. `seen_along` is the unit vector of the beam, away from
  /// the LiDAR. All in map.
  std::optional<SurfelMatch> match(const Eigen::Vector2d& point, double max_distance_m,
                                   const Eigen::Vector2d& seen_along) const;

  /// Appends the indices of the surfels whose middle part the line from one point to the other crosses; duplicates are
  /// possible.
  void append_crossed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<int>& indices) const;

 private:
  struct Range {
    const int* first;
    const int* last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
  };

  Eigen::Vector2d in_cells(const Eigen::Vector2d& point) const { return (point - origin_) / cell_m_; }
  bool contains(const Eigen::Vector2i& cell) const;
  Range surfels_in(const Eigen::Vector2i& cell) const;
  void choose_grid();
  void fill_grid();

  std::vector<Surfel> surfels_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cell_m_ = 1.0;
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  /// Surfels of cell i, row-major: listed_[starts_[i]] to listed_[starts_[i + 1]].
  std::vector<int> starts_;
  std::vector<int> listed_;
};

}  // namespace mtr_surfel_map
