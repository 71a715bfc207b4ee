/// @file
/// Decision of drive control at a tick.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mtr_core/problem.hpp"
#include "mtr_drive_control/collision/collision_stop.hpp"

namespace mtr_drive_control {

/// Velocity to send, and its reason.
struct Decision {
  Velocity velocity;
  /// none, locked, manual or planner.
  std::string source;
  std::vector<std::string> engaged_locks;
  /// One of them is not a stop ordered by the Operator.
  bool is_unordered_lock = false;
  /// One sentence, empty without a problem.
  mtr_core::Problem message;
  Zone zone = Zone::kClear;
  std::optional<Hindrance> hindrance;
};

}  // namespace mtr_drive_control
