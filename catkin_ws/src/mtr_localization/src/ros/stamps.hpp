/// @file
/// Times inside localization: on the steady clock, so that setting the ROS clock does not interrupt anything.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mtr_core/clock.hpp"

namespace mtr_localization {

/// Returns the time of the stamp of an arriving message; in simulation the stamp itself.
/// @param usual_age_ns see mtr_core::StampClock::time_of
inline std::int64_t time_of(std::int64_t stamp_ns, std::int64_t& usual_age_ns) {
  return mtr_core::is_simulated() ? stamp_ns
                                  : mtr_core::stamp_clock().time_of(stamp_ns, mtr_core::read_clocks(), usual_age_ns);
}

/// Returns the stamp for a message that is sent now.
inline std::int64_t stamp_of(std::int64_t time_ns) {
  return mtr_core::is_simulated() ? time_ns : mtr_core::stamp_clock().stamp_of(time_ns);
}

}  // namespace mtr_localization
