/// @file
/// Which stamps are of one instant.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace mtr_localization {

/// Stamps of one instant, also two equal ones, come to lie some microseconds apart on the steady clock
/// (mtr_core/stamp_clock.hpp). In such a time the robot drives 0.1 mm at most.
inline constexpr std::int64_t kOneInstantNs = 50'000;

}  // namespace mtr_localization
