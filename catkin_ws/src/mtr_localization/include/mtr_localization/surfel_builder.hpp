/// @file
/// Makes surface elements of points that were seen from several places.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mtr_localization/line_fit.hpp"
#include "mtr_localization/map_types.hpp"
#include "mtr_localization/surfel_search.hpp"

namespace mtr_localization {

/// Straight pieces of surface, each seen from at least three key-frames and fitted to all points near it.
std::vector<Surfel> build_surfels(const SeenPoints& points, const SurfelShape& shape);

}  // namespace mtr_localization
