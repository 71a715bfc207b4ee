/// @file
/// Makes one map of all key frames of a way round the Car.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_surfel_map/adjustment/parameters.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Poses of all key frames, surfaces, the LiDAR's range bias and the scales of wheels and gyro, adjusted together;
/// the first key frame stays where it was.
///
/// In rounds from coarse to fine: surfaces are made of all returns, each view is assigned to a surface, and poses and
/// surfaces move to where all agree best. Takes one core; the same input gives the same result.
AdjustedMap adjust(const std::vector<KeyFrame>& key_frames, const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
