/// @file
/// Residuals of the adjustment in sigmas: distances of views from surfaces, and deviations of motions from wheels and
/// gyro.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjustment/normal_equations.hpp"
#include "adjustment/observations.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// State of the adjustment.
struct Adjustment {
  std::vector<KeyFrame> key_frames;
  std::vector<Surfel> surfels;
  /// Only the value is adjusted; see Uncertainty for the covariance.
  RangeBias range_bias;
  /// True distance over wheel distance, less 1.
  double wheel_scale = 0.0;
  /// True turn over gyro turn, less 1.
  double gyro_scale = 0.0;
  /// Factor on the sigmas of wheels and gyro in the key frames.
  double motion_factor = 1.0;
};

/// Index of each unknown among the joint unknowns.
struct Layout {
  Eigen::Index key_frames;

  static Eigen::Index pose(Eigen::Index key_frame) { return 3 * key_frame; }
  /// Index for the first LiDAR; the other LiDARs follow.
  Eigen::Index range_bias() const { return 3 * key_frames; }
  Eigen::Index wheel_scale() const { return range_bias() + kLidars; }
  Eigen::Index gyro_scale() const { return wheel_scale() + 1; }
  Eigen::Index size() const { return gyro_scale() + 1; }
};

inline Layout layout_of(const Adjustment& state) { return {static_cast<Eigen::Index>(state.key_frames.size())}; }

/// Returns the distance of a view from its surfel, with derivatives with respect to pose and range biases. The
/// derivative with respect to the surfel offset is -1 / sigma, with respect to its lean -rise / sigma.
Residual<1, 3 + kLidars> surface_residual(const Adjustment& state, const Observation& seen);

/// Returns the motion since the previous key frame less the motion of wheels and gyro, with derivatives with respect to
/// both poses and both scales.
Residual<3, 8> motion_residual(const Adjustment& state, std::size_t key_frame);

}  // namespace mtr_surfel_map
