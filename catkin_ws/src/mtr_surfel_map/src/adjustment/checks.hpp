/// @file
/// Checks whether key frames can give a map, and whether a map can be trusted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "adjustment/problem.hpp"
#include "mtr_core/problem.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// Returns the reason why the key frames cannot give a map, or an empty problem.
mtr_core::Problem problem_with(const std::vector<KeyFrame>& key_frames);

/// Returns the reason why the adjusted map cannot be trusted, or an empty problem.
mtr_core::Problem problem_with(const Adjustment& state, const std::vector<Observation>& observations, const Fit& fit,
                               const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
