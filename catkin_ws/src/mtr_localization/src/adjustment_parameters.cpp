/// @file
/// Check of the parameters of the adjustment.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/adjustment_parameters.hpp"

namespace mtr_localization {

void check(const AdjustmentParameters& parameters) {
  for (const AdjustmentRow& row : kAdjustmentRows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

}  // namespace mtr_localization
