/// @file
/// Conversion of ranges to points without motion distortion.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "map_names.hpp"
#include "motion/filter_history.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

/// Returns the points of all sweeps of a set without motion distortion, in base_link at the stamp of the set's step.
///
/// Excluded are beams without a return, and beams whose range agrees with neither neighbour: rain drops, and beams on
/// an edge, which measure a range between two surfaces.
/// @param motion covers the times of all beams
ScanPoints deskew(const ScanSet& set, const FilterHistory& motion);

}  // namespace mtr_localization
