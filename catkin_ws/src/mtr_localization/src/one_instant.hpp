/// @file
/// Tolerance of equal stamps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace mtr_localization {

/// Messages with the same stamp may differ by microseconds on the steady clock (mtr_core/stamp_clock.hpp). In this
/// time, the robot moves by at most 0.1 mm.
inline constexpr std::int64_t kOneInstantNs = 50'000;

}  // namespace mtr_localization
