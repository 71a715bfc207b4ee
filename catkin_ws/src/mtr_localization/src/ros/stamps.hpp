/// @file
/// Times inside localization: the steady clock's, so that a ROS clock that is set interrupts nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mtr_core/clock.hpp"

namespace mtr_localization {

/// Time of the stamp of a message that arrives now; in simulation the stamp itself.
/// @param usual_age_ns see mtr_core::StampClock::time_of
inline std::int64_t time_of(std::int64_t stamp_ns, std::int64_t& usual_age_ns) {
  return mtr_core::is_simulated() ? stamp_ns
                                  : mtr_core::stamp_clock().time_of(stamp_ns, mtr_core::read_clocks(), usual_age_ns);
}

/// The stamp of such a time in a message that is sent now.
inline std::int64_t stamp_of(std::int64_t time_ns) {
  return mtr_core::is_simulated() ? time_ns : mtr_core::stamp_clock().stamp_of(time_ns);
}

}  // namespace mtr_localization
