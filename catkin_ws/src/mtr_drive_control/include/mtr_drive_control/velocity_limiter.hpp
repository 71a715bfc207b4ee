/// @file
/// Velocity of the base that changes no faster than its limits allow.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_drive_control/geometry.hpp"
#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Remembers the velocity sent last and tells the next one, one period later.
class VelocityLimiter {
 public:
  VelocityLimiter(const Parameters& parameters, double period_s) : limits_(parameters), period_s_(period_s) {}

  /// Limits from now on.
  void set_limits(const Parameters& limits) { limits_ = limits; }

  /// The wanted velocity, which must be finite, when it is not too fast; else the like on the same circle.
  Velocity within_limits(const Velocity& wanted) const;

  /// Next velocity on the way to the wanted one, which must be finite.
  Velocity toward(const Velocity& wanted) const;

  /// Next velocity of an emergency stop along the present circle.
  Velocity braked() const;

  /// This velocity is sent.
  void send(const Velocity& velocity) { sent_ = velocity; }
  const Velocity& sent() const { return sent_; }

 private:
  double next_linear(double wanted_mps) const;

  Parameters limits_;
  double period_s_;
  Velocity sent_;
};

}  // namespace mtr_drive_control
