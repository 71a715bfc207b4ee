/// @file
/// Search for straight pieces of surface among points.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "extraction/line_fit.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Criteria of a surface element.
struct SurfelShape {
  /// Side of the largest and of the smallest square in the search.
  double max_m;
  double min_m;
  /// Largest root mean square distance of the points from the surface.
  double thickness_m;
  /// Origin of the grid of squares; another origin cuts surfaces at other places.
  Eigen::Vector2d origin;
};

/// Returns the surfel along a line, or nothing if the points do not determine its direction.
std::optional<Surfel> surfel_along(const Line& line, int hits);

/// Returns the pieces of surface, each within one square. A square whose points are not on one line is divided in four,
/// like the adaptive voxels of Z. Liu and F. Zhang, "BALM: Bundle Adjustment for Lidar Mapping", IEEE Robotics and
/// Automation Letters 6(2), 2021.
std::vector<Surfel> search_surfels(SeenPoints points, const SurfelShape& shape);

}  // namespace mtr_surfel_map
