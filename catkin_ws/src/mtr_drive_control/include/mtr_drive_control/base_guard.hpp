/// @file
/// Velocity limits for a base whose own limits would tip the mast.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "mtr_drive_control/base_limits.hpp"
#include "mtr_drive_control/geometry.hpp"

namespace mtr_drive_control {

/// Substitute for limits in the base: follows commands with limited acceleration, and stops without commands.
///
/// After an own pause long enough for the base's time-out, it begins from standstill; after a shorter one from the last
/// velocity that it sent. Commands that waited in a queue during the pause have no time stamp, so for a short time all
/// commands are ignored.
class BaseGuard {
 public:
  BaseGuard(const BaseLimits& limits, double period_s) : limits_(limits), period_s_(period_s) {}

  /// Accepts a command that arrives now, ns of a clock that is never set; a non-finite command is ignored.
  void take(std::int64_t now_ns, const Velocity& command);

  /// Returns the velocity to send; must be called once per period.
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
