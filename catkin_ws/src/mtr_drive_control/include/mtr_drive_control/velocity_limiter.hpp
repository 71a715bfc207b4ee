/// @file
/// Velocity of the base that changes no faster than its limits allow.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "mtr_drive_control/base_limits.hpp"
#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {

/// Remembers the velocity sent last and tells the next one, one period later; or later, and then it has braked for all
/// of that time and gained speed for one period.
class VelocityLimiter {
 public:
  VelocityLimiter(const Limits& limits, double period_s) : limits_(limits), period_s_(period_s), braking_s_(period_s) {}

  /// Limits from now on.
  void set_limits(const Limits& limits) { limits_ = limits; }

  /// So long has the velocity that was sent last been in force; the base stops by itself after a while.
  void elapse(double since_s) { braking_s_ = std::clamp(since_s, period_s_, kMaxBaseTimeoutS); }

  /// The wanted velocity, which must be finite, when it is not too fast; else the like on the same circle.
  Velocity within_limits(const Velocity& wanted) const { return wanted.scaled(limits_.permitted_share(wanted)); }

  /// Next velocity on the way to the wanted one, which must be finite.
  Velocity toward(const Velocity& wanted) const;

  /// True when the velocity sent last is so much faster than the wheels, in one of its parts, that they do not follow.
  bool leads(const Velocity& measured) const;

  /// Next velocity of an emergency stop along the present circle.
  Velocity braked() const;

  /// This velocity is sent.
  void send(const Velocity& velocity) { sent_ = velocity; }
  const Velocity& sent() const { return sent_; }

  /// What was sent before counts no longer: the wheels do this, as far as it is a velocity that may be sent.
  void begin_from(const Velocity& measured) { sent_ = within_limits(measured); }

 private:
  double next_linear(double wanted_mps) const;
  double next_angular(double wanted_radps) const;

  Limits limits_;
  double period_s_;
  double braking_s_;
  Velocity sent_;
};

}  // namespace mtr_drive_control
