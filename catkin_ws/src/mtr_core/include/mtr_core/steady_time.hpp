/// @file
/// Two clocks: stamps are times of the ROS clock, which may be set at any time; ages are measured on a clock that is
/// never set. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <time.h>

#include <cstdint>
#include <limits>

#include "mtr_core/slot.hpp"

namespace mtr_core {

/// Returns the robot's steady clock in ns: it is never set and includes the time of a suspended machine.
inline std::int64_t boot_time_ns() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return time.tv_sec * kSecondNs + time.tv_nsec;
}

/// One instant on both clocks, in ns. In simulation both are the simulated clock.
struct Instant {
  /// On the steady clock, with an arbitrary origin.
  std::int64_t time_ns;
  /// On the ROS clock.
  std::int64_t stamp_ns;
};

/// A stamp that is at most this far ahead of its arrival is from a clock that was just set back, or that runs slightly
/// ahead. The message then counts as stamped at its arrival.
inline constexpr std::int64_t kMaxAheadNs = 100 * kMillisecondNs;

/// Time of a message that never counts: centuries in the future, and far from the end of the number range.
inline constexpr std::int64_t kNeverNs = std::numeric_limits<std::int64_t>::max() / 4;

/// Returns the steady time of a stamp of the ROS clock, for a message that arrives now.
///
/// Later steps of the ROS clock have no effect. A stamp far in the future is never fresh.
constexpr std::int64_t steady_time_of(std::int64_t stamp_ns, const Instant& now) {
  const std::int64_t ahead_ns = stamp_ns - now.stamp_ns;
  if (ahead_ns > kMaxAheadNs) {
    return kNeverNs;
  }
  return ahead_ns > 0 ? now.time_ns : now.time_ns + ahead_ns;
}

/// True when the message is not older than the time-out, and not more than kMaxAheadNs in the future.
inline bool is_fresh(std::int64_t time_ns, std::int64_t now_ns, double timeout_s) {
  return now_ns - time_ns >= -kMaxAheadNs && static_cast<double>(now_ns - time_ns) <= timeout_s * 1e9;
}

/// True when a node that woke for this tick was away for a period or more, so it has to process its callbacks first.
constexpr bool is_missed(const Slot& slot, std::int64_t tick_ns, std::int64_t now_ns) {
  return now_ns - tick_ns >= slot.period_ns;
}

}  // namespace mtr_core
