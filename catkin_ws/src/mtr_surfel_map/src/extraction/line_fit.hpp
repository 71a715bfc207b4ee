/// @file
/// Straight-line fits to returns.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Return in map.
struct SeenPoint {
  Eigen::Vector2d position;
  /// Unit vector along the beam, away from the LiDAR.
  Eigen::Vector2d direction;
  double range_m;
  int key_frame;
};

using SeenPoints = std::vector<SeenPoint>;

/// All functions use the points in [first, last).
using SeenPointIterator = SeenPoints::const_iterator;

/// Line through points.
struct Line {
  Eigen::Vector2d middle;
  /// Unit normal on the side from which most points were seen.
  Eigen::Vector2d normal;
  /// Root mean square distance of the points from the middle along the line, and from the line.
  double spread_m;
  double thickness_m;
  /// Mean cosine of the angle between beams and normal.
  double facing;

  Eigen::Vector2d along() const { return {-normal.y(), normal.x()}; }
  /// Returns the length of a line with evenly distributed points and this spread.
  double length_m() const;
};

/// Fits a line. The range must not be empty.
Line line_through(SeenPointIterator first, SeenPointIterator last);

/// Returns the largest mean deviation of a part of the points from the line, beyond chance: bow, step or bend.
double unevenness_m(SeenPointIterator first, SeenPointIterator last, const Line& line);

/// Returns true if enough points from enough places support a surface; rain and persons who walk by do not.
bool is_enough(SeenPointIterator first, SeenPointIterator last);

}  // namespace mtr_surfel_map
