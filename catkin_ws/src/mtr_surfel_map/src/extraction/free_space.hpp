/// @file
/// Removal of surfaces that were seen through: persons who walked on, cars that left, rain.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Returns the surfels except those with too many passing beams for their number of hits.
std::vector<Surfel> without_seen_through(const std::vector<Surfel>& surfels, const std::vector<KeyFrame>& key_frames);

}  // namespace mtr_surfel_map
