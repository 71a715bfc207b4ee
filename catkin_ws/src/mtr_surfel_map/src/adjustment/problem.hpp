/// @file
/// Least squares over poses, surface offsets and leans, range biases and scales of wheels and gyro for a given
/// association.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjustment/observations.hpp"
#include "adjustment/residuals.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"

namespace mtr_surfel_map {

/// Deviation of a pose from the dead reckoning of wheels and gyro since the previous key frame.
struct Jump {
  double distance_m = 0.0;
  double angle_rad = 0.0;
};

/// Agreement of the measurements after the adjustment.
struct Fit {
  /// Robust residual scale of the views in sigmas: 1 when the sigmas are correct. It comes from the median, which
  /// persons and parked cars that left do not affect.
  double surface_ratio = 0.0;
  /// Share of the views with a residual of more than 4 sigma.
  double outlier_share = 0.0;
  /// Root mean square residual of wheels and gyro, in the sigmas of the key frames.
  double motion_ratio = 0.0;
  /// Largest excluded deviation of a motion between consecutive key frames.
  Jump jump;
};

/// Uncertainty of the results.
struct Uncertainty {
  std::vector<Eigen::Matrix3d> poses;
  /// 1 sigma along the normal; 0 for a surfel without views.
  std::vector<double> surfels_m;
  /// 1 sigma of the lean of each surfel.
  std::vector<double> leans;
  Eigen::Matrix<double, kLidars, kLidars> range_bias = Eigen::Matrix<double, kLidars, kLidars>::Zero();
};

/// Minimises the residuals over poses and surfels; the first pose is fixed. Returns the largest position change of a
/// pose.
double solve(Adjustment& state, const std::vector<Observation>& observations, const AdjustmentParameters& parameters);

/// Returns the agreement of the measurements at the solution.
Fit fit_of(const Adjustment& state, const std::vector<Observation>& observations);

/// Returns the uncertainty at the solution, assuming correct sigmas of the measurements.
Uncertainty uncertainty_of(const Adjustment& state, const std::vector<Observation>& observations,
                           const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
