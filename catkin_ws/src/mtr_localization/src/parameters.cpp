/// @file
/// Check of the parameters of localization.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_localization/parameters.hpp"

#include "mtr_localization/tracking_parameters.hpp"

namespace mtr_localization {
namespace {

template <typename Rows, typename P>
void check_rows(const Rows& rows, const P& parameters) {
  for (const auto& row : rows) {
    mtr_core::check_range(row.name, parameters.*(row.member), row.low, row.high, row.unit);
  }
}

}  // namespace

void check(const Parameters& parameters) { check_rows(kRows, parameters); }

void check(const TrackingParameters& parameters) { check_rows(kTrackingRows, parameters); }

}  // namespace mtr_localization
