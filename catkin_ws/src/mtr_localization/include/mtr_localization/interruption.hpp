/// @file
/// Whether the motion between two wheel samples is known.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "mtr_localization/samples.hpp"
#include "mtr_localization/yaw_rate_history.hpp"

namespace mtr_localization {

/// One sentence when wheels or gyro were silent for longer than the limit or the wheels jumped; else empty.
std::string interruption_between(const WheelSample& last, const WheelSample& wheels, const YawRateHistory& gyro,
                                 std::int64_t gap_limit_ns);

}  // namespace mtr_localization
