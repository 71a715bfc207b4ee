/// @file
/// Range check of the adjustment parameters.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_surfel_map/adjustment/parameters.hpp"

namespace mtr_surfel_map {

void check(const AdjustmentParameters& parameters) {
  for (const AdjustmentRow& row : kAdjustmentRows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

}  // namespace mtr_surfel_map
