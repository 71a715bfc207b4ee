/// @file
/// Straight lines through returns.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// A return in map.
struct SeenPoint {
  Eigen::Vector2d position;
  /// Unit vector along the beam, away from the LiDAR.
  Eigen::Vector2d direction;
  double range_m;
  int key_frame;
};

using SeenPoints = std::vector<SeenPoint>;

/// A run of points; all functions take the points of [first, last).
using SeenPointIterator = SeenPoints::const_iterator;

/// Line through points.
struct Line {
  Eigen::Vector2d middle;
  /// It points to the side from which most points were seen.
  Eigen::Vector2d normal;
  /// Root mean square distance of the points from the middle along the line, and from the line.
  double spread_m;
  double thickness_m;
  /// Mean cosine of the angle between beams and normal.
  double facing;

  Eigen::Vector2d along() const { return {-normal.y(), normal.x()}; }
  /// Length of a line over which the points are spread evenly.
  double length_m() const;
};

/// There must be a point.
Line line_through(SeenPointIterator first, SeenPointIterator last);

/// How far parts of the points lie off the line on average, beyond what their number explains: bow, step or bend.
double unevenness_m(SeenPointIterator first, SeenPointIterator last, const Line& line);

/// Enough points from enough places, so that they are neither rain nor a person who walks by.
bool is_enough(SeenPointIterator first, SeenPointIterator last);

}  // namespace mtr_surfel_map
