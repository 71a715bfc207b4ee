/// @file
/// What the adjustment makes small: distances of views from surfaces and contradictions to wheels and gyro, in sigmas.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjustment/normal_equations.hpp"
#include "adjustment/observations.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Everything that is adjusted together.
struct Adjustment {
  std::vector<KeyFrame> key_frames;
  std::vector<Surfel> surfels;
  /// Its covariance stays what it was: see Uncertainty.
  RangeBias range_bias;
  /// True distance over the wheels' distance, less 1.
  double wheel_scale = 0.0;
  /// True turn over the gyro's turn, less 1.
  double gyro_scale = 0.0;
  /// By how much the sigmas of wheels and gyro are larger than the key frames say.
  double motion_factor = 1.0;
};

/// Where each unknown stands among the joint ones.
struct Layout {
  Eigen::Index key_frames;

  static Eigen::Index pose(Eigen::Index key_frame) { return 3 * key_frame; }
  /// Of the first LiDAR; those of the others follow.
  Eigen::Index range_bias() const { return 3 * key_frames; }
  Eigen::Index wheel_scale() const { return range_bias() + kLidars; }
  Eigen::Index gyro_scale() const { return wheel_scale() + 1; }
  Eigen::Index size() const { return gyro_scale() + 1; }
};

inline Layout layout_of(const Adjustment& state) { return {static_cast<Eigen::Index>(state.key_frames.size())}; }

/// Distance of a view from its surfel; by pose and range biases. Its derivative by a shift of the surfel along the
/// normal is -1 / sigma, by its lean -rise / sigma.
Residual<1, 3 + kLidars> surface_residual(const Adjustment& state, const Observation& seen);

/// Motion from the key frame before to this one against that of wheels and gyro; by both poses and the scales of
/// wheels and gyro.
Residual<3, 8> motion_residual(const Adjustment& state, std::size_t key_frame);

}  // namespace mtr_surfel_map
