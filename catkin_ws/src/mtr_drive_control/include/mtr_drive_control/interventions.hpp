/// @file
/// Interventions in the robot's motion, other than the Operator's orders.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mtr_drive_control/decision.hpp"

namespace mtr_drive_control {

/// Counters since the start; they never decrease.
struct Interventions {
  /// Number of times that the manual controller took over.
  std::uint32_t manual_drives = 0;
  /// Stops of a moving source for an obstacle or for blindness.
  std::uint32_t blockages = 0;
  /// Motion locks that ended a motion, except the stop ordered by the Operator.
  std::uint32_t lock_stops = 0;
};

/// Counts the starts of interventions in the decisions of all ticks.
class InterventionCounter {
 public:
  /// Accepts the next decision; returns the counters including it.
  const Interventions& count(const Decision& decision);

 private:
  Interventions counted_;
  Decision before_;
};

}  // namespace mtr_drive_control
