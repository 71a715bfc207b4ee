/// @file
/// Detects the starts of manual driving, blockages and locks.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/interventions.hpp"

namespace mtr_drive_control {
namespace {

bool is_blocked(const Decision& decision) {
  const bool is_driven = decision.source == "manual" || decision.source == "planner";
  return is_driven && (decision.zone == Zone::kBlocked || decision.zone == Zone::kBlind);
}

}  // namespace

const Interventions& InterventionCounter::count(const Decision& decision) {
  counted_.manual_drives += decision.source == "manual" && before_.source != "manual" ? 1 : 0;
  counted_.blockages += is_blocked(decision) && !is_blocked(before_) ? 1 : 0;
  counted_.lock_stops +=
      decision.is_unordered_lock && !before_.is_unordered_lock && !before_.velocity.is_zero() ? 1 : 0;
  before_ = decision;
  return counted_;
}

}  // namespace mtr_drive_control
