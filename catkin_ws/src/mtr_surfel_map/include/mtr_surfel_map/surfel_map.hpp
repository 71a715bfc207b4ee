/// @file
/// Surface elements with quick answers to "which one is near" and "which ones does this line of sight cross".
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// The surface element that a point lies on.
struct SurfelMatch {
  const Surfel* surfel;
  /// Distance of the point from the surface, positive on the side of the normal.
  double distance_along_normal_m;
};

/// Fixed set of surfels; answers are found through a grid of cells that lists the surfels in each.
class SurfelMap {
 public:
  SurfelMap() = default;
  explicit SurfelMap(std::vector<Surfel> surfels);

  const std::vector<Surfel>& surfels() const { return surfels_; }

  /// The surfel nearest to a point along its normal: one that faces the viewer, beside which the point lies, and not
  /// farther than max_distance_m. `seen_along` is the unit vector of the beam, away from the LiDAR. All in map.
  std::optional<SurfelMatch> match(const Eigen::Vector2d& point, double max_distance_m,
                                   const Eigen::Vector2d& seen_along) const;

  /// Appends the indices of the surfels whose middle part lies in the way from one point to the other; one may appear
  /// more than once.
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
