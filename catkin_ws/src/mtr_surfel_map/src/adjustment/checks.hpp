/// @file
/// Whether key frames can give a map, and whether a map can be trusted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "adjustment/problem.hpp"
#include "mtr_core/problem.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Why no map can be made of the key frames; none when one can.
mtr_core::Problem problem_with(const std::vector<KeyFrame>& key_frames);

/// Why the adjusted map cannot be trusted; none when it can.
mtr_core::Problem problem_with(const Adjustment& state, const std::vector<Observation>& observations, const Fit& fit,
                               const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
