/// @file
/// Makes surface elements of points that were seen from several places.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mtr_localization/map_types.hpp"

namespace mtr_localization {

/// A return in map.
struct SeenPoint {
  Eigen::Vector2d position;
  /// Unit vector along the beam, away from the LiDAR.
  Eigen::Vector2d direction;
  double range_m;
  int key_frame;
};

/// What counts as a surface element.
struct SurfelShape {
  /// Side of the largest and smallest square that is searched for one.
  double largest_m;
  double smallest_m;
  /// Root mean square distance of its points from it at most.
  double thickness_m;
  /// Where the grid of squares begins: another choice cuts surfaces elsewhere.
  Eigen::Vector2d origin;
};

/// Straight pieces of surface that at least three key-frames saw.
///
/// Squares in which the points do not lie on one line are divided in four, as in the adaptive voxels of Z. Liu and
/// F. Zhang, "BALM: Bundle Adjustment for Lidar Mapping", IEEE Robotics and Automation Letters 6(2), 2021.
std::vector<Surfel> build_surfels(std::vector<SeenPoint> points, const SurfelShape& shape);

}  // namespace mtr_localization
