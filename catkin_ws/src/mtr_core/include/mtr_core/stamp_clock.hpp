/// @file
/// Converts stamps of a ROS clock that may be set to the continuous steady clock. No ROS.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "mtr_core/steady_time.hpp"

namespace mtr_core {

/// A larger change of the offset between two readings is a step: NTP slews by at most 0.5 ms per s. The same value is
/// in mtr_core/liveness.py.
inline constexpr std::int64_t kClockStepNs = 20 * kMillisecondNs;
/// Time after a step in which messages stamped before it may still arrive.
inline constexpr std::int64_t kUnderWayNs = kSecondNs;
/// The offset follows the readings by at most 1 ns in this many ns, so that a late reading does not shift all stamps.
inline constexpr std::int64_t kNsPerNsOfSlew = 1000;

/// Stores the offset of the ROS clock from the steady clock, currently and before the last step.
class StampClock {
 public:
  /// Returns the steady time of the stamp of a message that arrives now.
  ///
  /// Soon after a step the message may have been stamped before it, with the former offset. No message is from the
  /// future. If both offsets are possible, the one applies with which the message's age is closer to the usual one.
  /// @param usual_age_ns age of this producer's newest message outside such a period; updated by this message
  std::int64_t time_of(std::int64_t stamp_ns, const Instant& now, std::int64_t& usual_age_ns) {
    follow(now);
    const std::int64_t time_ns = stamp_ns - offset_ns_;
    if (was_set_ && now.time_ns - set_ns_ <= kUnderWayNs) {
      return is_of_before(stamp_ns, now.time_ns, usual_age_ns) ? stamp_ns - former_ns_ : time_ns;
    }
    usual_age_ns = now.time_ns - time_ns;
    return time_ns;
  }

  /// Returns the stamp of a steady time, with the ROS clock's offset of the newest reading.
  std::int64_t stamp_of(std::int64_t time_ns) const { return time_ns + offset_ns_; }

 private:
  bool is_of_before(std::int64_t stamp_ns, std::int64_t now_ns, std::int64_t usual_age_ns) const {
    // A producer's clock may run ahead of this clock.
    const std::int64_t ahead_ns = kClockStepNs + std::max<std::int64_t>(0, -usual_age_ns);
    const auto misfit = [&](std::int64_t time_ns) { return std::abs(now_ns - time_ns - usual_age_ns); };
    const std::int64_t time_ns = stamp_ns - offset_ns_;
    const std::int64_t former_time_ns = stamp_ns - former_ns_;
    const bool may_be = former_time_ns <= set_ns_ + ahead_ns;
    const bool must_be = time_ns > now_ns + ahead_ns;
    return may_be && (must_be || misfit(former_time_ns) < misfit(time_ns));
  }

  void follow(const Instant& now) {
    const std::int64_t offset_ns = now.stamp_ns - now.time_ns;
    if (!is_known_) {
      is_known_ = true;
      offset_ns_ = offset_ns;
    } else if (std::abs(offset_ns - offset_ns_) > kClockStepNs) {
      former_ns_ = offset_ns_;
      was_set_ = true;
      offset_ns_ = offset_ns;
      set_ns_ = now.time_ns;
    } else {
      const std::int64_t slew_ns = (now.time_ns - read_ns_) / kNsPerNsOfSlew;
      offset_ns_ += std::clamp(offset_ns - offset_ns_, -slew_ns, slew_ns);
    }
    read_ns_ = now.time_ns;
  }

  // Plain numbers, because GCC 12 warns that those in a std::optional are uninitialized.
  bool is_known_ = false;
  std::int64_t offset_ns_ = 0;
  // Offset before the last step, and the time of the step.
  bool was_set_ = false;
  std::int64_t former_ns_ = 0;
  std::int64_t set_ns_ = 0;
  std::int64_t read_ns_ = 0;
};

}  // namespace mtr_core
