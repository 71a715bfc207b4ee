/// @file
/// What happened to the robot's motion beside the Operator's orders.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mtr_drive_control/decision.hpp"

namespace mtr_drive_control {

/// Counters since the start; they only grow.
struct Interventions {
  /// Times that the manual controller took the wheels.
  std::uint32_t manual_drives = 0;
  /// Stops for an obstacle or for blindness, of a source that wants to drive.
  std::uint32_t blockages = 0;
  /// Motion locks that ended a motion, but for the stop that the Operator orders.
  std::uint32_t lock_stops = 0;
};

/// Counts what the decisions of all ticks begin.
class InterventionCounter {
 public:
  /// Takes the next decision; the counters with it.
  const Interventions& count(const Decision& decision);

 private:
  Interventions counted_;
  Decision before_;
};

}  // namespace mtr_drive_control
