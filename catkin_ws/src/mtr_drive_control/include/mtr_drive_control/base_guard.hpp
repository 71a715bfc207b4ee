/// @file
/// Velocity for a base that has no limits of its own that the mast would survive.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mtr_drive_control/base_limits.hpp"
#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

/// What the base itself would do with the limits: follow commands no faster than they allow, and stop when none comes.
///
/// After a pause of its own, in which a base stops by its time-out, it begins from standstill; after a shorter one from
/// what it sent last. Commands that waited in a queue meanwhile bear no time, so for a moment none is listened to.
class BaseGuard {
 public:
  BaseGuard(const BaseLimits& limits, double period_s) : limits_(limits), period_s_(period_s) {}

  /// A command that arrives now, ns of a clock that nobody sets; one that is not finite counts as none.
  void take(std::int64_t now_ns, const Velocity& command);

  /// Velocity to send; to be called once per period.
  Velocity step(std::int64_t now_ns);

 private:
  void notice_pause(std::int64_t now_ns);

  BaseLimits limits_;
  double period_s_;
  Velocity command_;
  Velocity sent_;
  std::optional<std::int64_t> commanded_ns_;
  std::optional<std::int64_t> stepped_ns_;
  std::int64_t deaf_until_ns_ = 0;
};

}  // namespace mtr_drive_control
