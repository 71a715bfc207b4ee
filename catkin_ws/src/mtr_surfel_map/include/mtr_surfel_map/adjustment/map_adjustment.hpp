/// @file
/// Adjusts all key frames of a drive round the Car to one map.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_surfel_map/adjustment/parameters.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Adjusts the poses of all key frames, the surfaces, the range bias of the LiDARs and the scales of wheels and gyro
/// together. The first key frame keeps its pose.
///
/// Rounds run from coarse to fine. Each round extracts surfels from all returns, assigns each view to a surfel, and
/// minimises the weighted residuals. Runs on one core; the same input gives the same result.
AdjustedMap adjust(const std::vector<KeyFrame>& key_frames, const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
