/// @file
/// Surfaces that were seen through: persons who walked on, cars that left, rain.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// The surfels without those through which beams passed too often for their number of hits.
std::vector<Surfel> without_seen_through(const std::vector<Surfel>& surfels, const std::vector<KeyFrame>& key_frames);

}  // namespace mtr_surfel_map
