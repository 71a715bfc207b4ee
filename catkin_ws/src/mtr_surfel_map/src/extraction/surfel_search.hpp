/// @file
/// Finds straight pieces of surface among points.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "extraction/line_fit.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// What counts as a surface element.
struct SurfelShape {
  /// Side of the largest and smallest square that is searched for one.
  double max_m;
  double min_m;
  /// Root mean square distance of its points from it at most.
  double thickness_m;
  /// Where the grid of squares begins: another choice cuts surfaces elsewhere.
  Eigen::Vector2d origin;
};

/// The surfel along a line, unless its points say too little about its direction.
std::optional<Surfel> surfel_along(const Line& line, int hits);

/// Pieces that lie in one square each. A square in which the points do not lie on one line is divided in four, as are
/// the adaptive voxels of Z. Liu and F. Zhang, "BALM: Bundle Adjustment for Lidar Mapping", IEEE Robotics and
/// Automation Letters 6(2), 2021.
std::vector<Surfel> search_surfels(SeenPoints points, const SurfelShape& shape);

}  // namespace mtr_surfel_map
