/// @file
/// Check of the parameters of localization.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/parameters.hpp"

namespace mtr_localization {

void check(const Parameters& parameters) {
  for (const Row& row : kRows) {
    mtr_lockstep::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

}  // namespace mtr_localization
