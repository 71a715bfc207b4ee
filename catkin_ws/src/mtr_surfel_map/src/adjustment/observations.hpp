/// @file
/// Which surface element each key frame saw where.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "extraction/line_fit.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"
#include "mtr_surfel_map/surfel_map.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// One key frame's view of one surfel: the mean of its returns from there, in base_link.
struct Observation {
  int key_frame;
  int surfel;
  Eigen::Vector2d position;
  /// Column by column for each LiDAR its part of the mean of the beams' directions: range errors e of the LiDARs move
  /// the position by directions * e.
  Eigen::Matrix<double, 2, kLidars> directions;
  /// 1 sigma of the position along the surfel's normal.
  double sigma_m;
  int beams;
  /// Mean of the beams' rises, the lowest and the highest one.
  double rise_m = 0.0;
  double lowest_rise_m = 0.0;
  double highest_rise_m = 0.0;
};

/// All returns in map, free of range biases.
SeenPoints points_in_map(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias);

/// Views of the surfels by returns that lie within the gate of them.
std::vector<Observation> observe(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias,
                                 const SurfelMap& map, double gate_m, const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
