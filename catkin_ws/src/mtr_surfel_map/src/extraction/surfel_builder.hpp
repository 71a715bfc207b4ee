/// @file
/// Extracts surface elements from points seen from several places.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "extraction/line_fit.hpp"
#include "extraction/surfel_search.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Returns straight pieces of surface, each seen from at least three key frames and fitted to all nearby points.
std::vector<Surfel> build_surfels(const SeenPoints& points, const SurfelShape& shape);

}  // namespace mtr_surfel_map
