/// @file
/// Which surfaces of a map are wrong together.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map_names.hpp"

namespace mtr_localization {

/// Surfels that lie near each other and look the same way were made by the same beams, so they share one error.
struct ErrorSources {
  /// Source of each surfel.
  std::vector<int> of_surfel;
  /// Sources of surfels; the constant error of the range is one more.
  int count = 0;
};

ErrorSources error_sources_of(const std::vector<Surfel>& surfels);

}  // namespace mtr_localization
