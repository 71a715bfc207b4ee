/// @file
/// Whether key frames can give a map, and whether a map can be trusted.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "adjustment/problem.hpp"
#include "mtr_surfel_map/types.hpp"

namespace mtr_surfel_map {

/// One sentence on why no map can be made of the key frames; empty when one can.
std::string problem_with(const std::vector<KeyFrame>& key_frames);

/// One sentence on why the adjusted map cannot be trusted; empty when it can.
std::string problem_with(const Adjustment& state, const std::vector<Observation>& observations, const Fit& fit,
                         const AdjustmentParameters& parameters);

}  // namespace mtr_surfel_map
