/// @file
/// Grid traversal along a line.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace mtr_surfel_map {

/// Calls visit(Eigen::Vector2i) for each cell on the line, in order; `from` and `to` are in units of cells.
///
/// J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.
template <typename Visit>
void walk_cells(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Visit visit) {
  const Eigen::Vector2d line = to - from;
  Eigen::Vector2i cell = from.array().floor().cast<int>();
  const Eigen::Vector2i last = to.array().floor().cast<int>();
  Eigen::Vector2i step;
  Eigen::Vector2d next;
  Eigen::Vector2d stride;
  for (int axis = 0; axis < 2; ++axis) {
    step[axis] = line[axis] > 0.0 ? 1 : -1;
    stride[axis] = line[axis] == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(line[axis]);
    const double border = cell[axis] + (line[axis] > 0.0 ? 1.0 : 0.0);
    next[axis] = line[axis] == 0.0 ? stride[axis] : (border - from[axis]) / line[axis];
  }
  visit(cell);
  // The number of steps is fixed beforehand, so that rounding at a corner of the last cell cannot extend the walk.
  for (int left = (last - cell).cwiseAbs().sum(); left > 0; --left) {
    const int axis = next[0] < next[1] ? 0 : 1;
    cell[axis] += step[axis];
    next[axis] += stride[axis];
    visit(cell);
  }
}

}  // namespace mtr_surfel_map
