/// @file
/// When a look for silent sensors counts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

namespace mtr_localization {

/// A node that was woken late looks at the time before it has read what was said meanwhile. So its first look after
/// that says nothing; the next one counts whatever it was, for a node that is always late has to notice silence, too.
class SilenceTurn {
 public:
  /// @param period_ns between two looks of a node that is in time
  explicit SilenceTurn(std::int64_t period_ns) : late_ns_(period_ns + period_ns / 2) {}

  /// True when a look at now_ns counts.
  bool counts(std::int64_t now_ns) {
    const bool is_late = now_ns > in_time_until_ns_;
    in_time_until_ns_ = now_ns + late_ns_;
    is_excused_ = is_late && !is_excused_;
    return !is_excused_;
  }

 private:
  std::int64_t late_ns_;
  // The first look is never late.
  std::int64_t in_time_until_ns_ = std::numeric_limits<std::int64_t>::max();
  bool is_excused_ = false;
};

}  // namespace mtr_localization
