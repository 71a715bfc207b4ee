/// @file
/// Limits the rate of change of the base's velocity.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "mtr_drive_control/base_limits.hpp"
#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/tip_over.hpp"

namespace mtr_drive_control {

/// Remembers the velocity sent last and computes the next one, one period later. If it is later than that, it brakes
/// for all of that time and accelerates for one period.
class VelocityLimiter {
 public:
  VelocityLimiter(const Limits& limits, double period_s) : limits_(limits), period_s_(period_s), braking_s_(period_s) {}

  /// Sets the limits from now on.
  void set_limits(const Limits& limits) { limits_ = limits; }

  /// Sets the time since the last velocity was sent; the base stops by itself after some time.
  void elapse(double since_s) { braking_s_ = std::clamp(since_s, period_s_, kMaxBaseTimeoutS); }

  /// Returns the desired velocity, which must be finite, reduced on its circle if it is too fast.
  Velocity within_limits(const Velocity& wanted) const { return wanted.scaled(limits_.permitted_share(wanted)); }

  /// Returns the next velocity towards the desired one, which must be finite.
  Velocity toward(const Velocity& wanted) const;

  /// Returns true if the velocity sent last exceeds the wheels' in a component by more than they can follow.
  bool leads(const Velocity& measured) const;

  /// Returns the next velocity of an emergency stop along the current circle.
  Velocity braked() const;

  /// Records the velocity that is sent.
  void send(const Velocity& velocity) { sent_ = velocity; }
  const Velocity& sent() const { return sent_; }

  /// Replaces the velocity sent last by the wheels' velocity, as far as it is permitted.
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
