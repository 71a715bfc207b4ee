/// @file
/// Views: association of the returns of each key frame with surface elements.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "extraction/line_fit.hpp"
#include "mtr_surfel_map/adjustment/parameters.hpp"
#include "mtr_surfel_map/surfel_map.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// View of one surfel from one key frame: mean of its returns, in base_link.
struct Observation {
  int key_frame;
  int surfel;
  Eigen::Vector2d position;
  /// Share of each LiDAR in the mean beam direction, one column per LiDAR. Range errors e of the LiDARs move the
  /// position by directions * e.
  Eigen::Matrix<double, 2, kLidars> directions;
  /// 1 sigma of the position along the surfel's normal.
  double sigma_m;
  int beams;
  /// Mean, lowest and highest rise of the beams.
  double rise_m = 0.0;
  double lowest_rise_m = 0.0;
  double highest_rise_m = 0.0;
};

/// Returns all returns in map, corrected by the range biases.
SeenPoints points_in_map(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias);

/// Returns the views of the surfels; a return belongs to a view if it is within the gate of the surfel.
std::vector<Observation> observe(const std::vector<KeyFrame>& key_frames, const RangeBias& range_bias,
                                 const SurfelMap& map, double gate_m, const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
