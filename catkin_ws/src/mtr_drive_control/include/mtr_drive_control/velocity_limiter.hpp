/// @file
/// Velocity of the base that changes no faster than its limits allow.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mtr_drive_control/parameters.hpp"

namespace mtr_drive_control {

/// Velocity of base_link: linear along its x axis, angular about z, counterclockwise.
struct Velocity {
  double linear_mps = 0.0;
  double angular_radps = 0.0;

  bool is_finite() const;
};

/// Remembers the velocity sent last and moves it towards the wanted one, one period per call.
class VelocityLimiter {
 public:
  VelocityLimiter(const Parameters& parameters, double period_s) : parameters_(parameters), period_s_(period_s) {}

  /// Next velocity on the way to the wanted one, which must be finite. Keeps the curvature of what is too fast.
  Velocity follow(const Velocity& wanted);

  /// Next velocity of an emergency stop along the present curve.
  Velocity stop();

 private:
  Velocity within_limits(const Velocity& wanted) const;
  double next_linear(double wanted_mps) const;

  Parameters parameters_;
  double period_s_;
  Velocity sent_;
};

}  // namespace mtr_drive_control
