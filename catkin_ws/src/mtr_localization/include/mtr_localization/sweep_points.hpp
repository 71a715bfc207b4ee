/// @file
/// From ranges to points without motion distortion.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mtr_localization/filter_history.hpp"
#include "mtr_localization/map_names.hpp"
#include "mtr_localization/sweep.hpp"

namespace mtr_localization {

/// Appends a sweep's returns, as seen from base_link at scan.stamp_ns.
///
/// Left out: beams without a return, and those whose range agrees with neither neighbour's: drops of rain, and beams
/// that meet an edge and say a range between two surfaces.
/// @param motion covers the times of all beams
void append_points(const Sweep& sweep, const FilterHistory& motion, ScanPoints& scan);

}  // namespace mtr_localization
