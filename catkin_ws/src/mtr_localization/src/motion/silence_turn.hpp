/// @file
/// Validity of checks for silent sensors.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

namespace mtr_localization {

/// Excuses the first check after a delay, because a delayed node checks before it has read the messages that arrived in
/// between. The next check always counts, so that a permanently delayed node detects silence, too.
class SilenceTurn {
 public:
  /// @param period_ns time between two checks of a node that is on time
  explicit SilenceTurn(std::int64_t period_ns) : late_ns_(period_ns + period_ns / 2) {}

  /// Returns true if a check at now_ns counts.
  bool counts(std::int64_t now_ns) {
    const bool is_late = now_ns > in_time_until_ns_;
    in_time_until_ns_ = now_ns + late_ns_;
    is_excused_ = is_late && !is_excused_;
    return !is_excused_;
  }

 private:
  std::int64_t late_ns_;
  // The first check is never late.
  std::int64_t in_time_until_ns_ = std::numeric_limits<std::int64_t>::max();
  bool is_excused_ = false;
};

}  // namespace mtr_localization
