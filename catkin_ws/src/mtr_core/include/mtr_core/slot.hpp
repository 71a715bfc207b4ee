/// @file
/// Ticks of a periodic producer; the slots of the nodes are in schedule.hpp, generated from mtr_core/schedule.py.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace mtr_core {

constexpr std::int64_t kMillisecondNs = 1'000'000;
constexpr std::int64_t kSecondNs = 1'000 * kMillisecondNs;

/// Period and phase of one periodic producer, in ns of the ROS clock; its ticks are n * period + phase.
struct Slot {
  std::int64_t period_ns;
  std::int64_t phase_ns;

  /// Returns the first tick later than time_ns.
  constexpr std::int64_t next_after(std::int64_t time_ns) const { return last_at(time_ns) + period_ns; }

  /// Returns the last tick not later than time_ns.
  constexpr std::int64_t last_at(std::int64_t time_ns) const {
    const std::int64_t since_phase = time_ns - phase_ns;
    const std::int64_t past_tick = (since_phase % period_ns + period_ns) % period_ns;
    return time_ns - past_tick;
  }
};

/// Returns a slot with period and phase in milliseconds.
constexpr Slot slot(std::int64_t period_ms, std::int64_t phase_ms = 0) {
  return {period_ms * kMillisecondNs, phase_ms * kMillisecondNs};
}

}  // namespace mtr_core
