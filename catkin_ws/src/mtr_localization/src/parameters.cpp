/// @file
/// Range check of the parameters.
// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

namespace mtr_localization {

void check(const Parameters& parameters) {
  for_each_group(parameters, [](const auto& rows, const auto& group) {
    for (const auto& row : rows) {
      mtr_core::check_range(row.name, group.*(row.member), row.low, row.high, row.unit);
    }
  });
}

}  // namespace mtr_localization
