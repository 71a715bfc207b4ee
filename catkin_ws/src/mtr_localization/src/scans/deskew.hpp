/// @file
/// From ranges to points without motion distortion.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "map_names.hpp"
#include "motion/filter_history.hpp"
#include "scans/sweep.hpp"

namespace mtr_localization {

/// Returns of all sweeps of a set without motion distortion, as seen from base_link at the stamp of the set's step.
///
/// Left out: beams without a return, and those whose range agrees with neither neighbour's: drops of rain, and beams
/// that meet an edge and say a range between two surfaces.
/// @param motion covers the times of all beams
ScanPoints deskew(const ScanSet& set, const FilterHistory& motion);

}  // namespace mtr_localization
