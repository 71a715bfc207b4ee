/// @file
/// Two clocks: stamps are of the ROS clock, which may be set at any time; ages are counted on one that nobody sets.
/// No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <time.h>

#include <cstdint>
#include <limits>

#include "mtr_core/slot.hpp"

namespace mtr_core {

/// The robot's steady clock in ns: nobody sets it, and it counts the time for which the machine was suspended.
inline std::int64_t boot_time_ns() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return time.tv_sec * kSecondNs + time.tv_nsec;
}

/// One instant on both clocks, in ns. In simulation both are the simulated clock.
struct Instant {
  /// On the steady clock, from any origin.
  std::int64_t time_ns;
  /// On the ROS clock.
  std::int64_t stamp_ns;
};

/// A stamp that is no farther ahead of its arrival comes from a clock that was just set back, or that runs a little
/// ahead: the message is as old as its arrival.
inline constexpr std::int64_t kMaxAheadNs = 100 * kMillisecondNs;

/// Time of what counts at no time: centuries ahead, and far from the end of the numbers.
inline constexpr std::int64_t kNeverNs = std::numeric_limits<std::int64_t>::max() / 4;

/// The steady time of a stamp of the ROS clock, by a message that arrives now.
///
/// What happens to the ROS clock afterwards changes nothing. A stamp far ahead is fresh at no time.
constexpr std::int64_t steady_time_of(std::int64_t stamp_ns, const Instant& now) {
  const std::int64_t ahead_ns = stamp_ns - now.stamp_ns;
  if (ahead_ns > kMaxAheadNs) {
    return kNeverNs;
  }
  return ahead_ns > 0 ? now.time_ns : now.time_ns + ahead_ns;
}

/// True when the word is not older than the time-out, nor from a future that no clock in order tells of.
inline bool is_fresh(std::int64_t time_ns, std::int64_t now_ns, double timeout_s) {
  return now_ns - time_ns >= -kMaxAheadNs && static_cast<double>(now_ns - time_ns) <= timeout_s * 1e9;
}

/// True when a node that woke for this tick at this time was away for so long that it has to look around first.
constexpr bool is_missed(const Slot& slot, std::int64_t tick_ns, std::int64_t now_ns) {
  return now_ns - tick_ns >= slot.period_ns;
}

}  // namespace mtr_core
