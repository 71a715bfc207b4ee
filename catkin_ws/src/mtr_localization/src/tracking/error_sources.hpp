/// @file
/// Groups of surfaces with a common error.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Adjacent surfels with the same orientation were measured by the same beams, so they have one common error.
struct ErrorSources {
  /// Error source of each surfel.
  std::vector<int> of_surfel;
  /// Number of sources of surfels, without the range errors.
  int count = 0;
};

ErrorSources error_sources_of(const std::vector<Surfel>& surfels);

}  // namespace mtr_localization
