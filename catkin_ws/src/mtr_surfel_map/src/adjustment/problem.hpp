/// @file
/// Least squares over poses, surface offsets, range biases and scales of wheels and gyro for a given association.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjustment/observations.hpp"
#include "adjustment/residuals.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"

namespace mtr_surfel_map {

/// Distance and angle by which a pose is elsewhere than wheels and gyro have led from the key frame before.
struct Jump {
  double distance_m = 0.0;
  double angle_rad = 0.0;
};

/// How well the measurements agree after the adjustment.
struct Fit {
  /// Size of the differences between surfaces and views in their sigmas: 1 when the sigmas are right. From the median,
  /// which persons and parked cars that left do not touch.
  double surface_ratio = 0.0;
  /// Share of the views that lie more than 4 sigma off.
  double outlier_share = 0.0;
  /// Root mean square of the differences between wheels and gyro and the poses, in the sigmas that the
  /// key frames say.
  double motion_ratio = 0.0;
  /// Largest difference of one motion from one key frame to the next, of those that wheels and gyro exclude.
  Jump jump;
};

/// Uncertainty of the results.
struct Uncertainty {
  std::vector<Eigen::Matrix3d> poses;
  /// 1 sigma along the normal; 0 for a surfel that nobody saw.
  std::vector<double> surfels_m;
  /// 1 sigma of the surfels' leans.
  std::vector<double> leans;
  Eigen::Matrix<double, kLidars, kLidars> range_bias = Eigen::Matrix<double, kLidars, kLidars>::Zero();
};

/// Moves poses and surfels to where all views agree best; the first pose stays. Returns the largest motion of a place.
double solve(Adjustment& state, const std::vector<Observation>& observations, const AdjustmentParameters& parameters);

/// How well they agree at the solution.
Fit fit_of(const Adjustment& state, const std::vector<Observation>& observations);

/// Uncertainty at the solution, when the sigmas of the measurements are right.
Uncertainty uncertainty_of(const Adjustment& state, const std::vector<Observation>& observations,
                           const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
