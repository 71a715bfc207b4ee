/// @file
/// Choice of the source of motion.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/drive_control.hpp"

namespace mtr_drive_control {

DriveControl::DriveControl(const Parameters& parameters, double period_s)
    : parameters_(parameters), limiter_(parameters, period_s) {
  check(parameters);
}

Decision DriveControl::step(std::int64_t tick_ns, const Inputs& inputs) {
  const Wish wish = choose(tick_ns, inputs);
  Decision decision;
  decision.velocity = wish.velocity ? limiter_.follow(*wish.velocity) : limiter_.stop();
  decision.source = wish.source;
  decision.message = wish.message;
  for (const EngagedLock& lock : inputs.locks) {
    decision.engaged_locks.push_back(lock.owner);
  }
  return decision;
}

DriveControl::Wish DriveControl::choose(std::int64_t tick_ns, const Inputs& inputs) const {
  if (!inputs.locks.empty()) {
    return {"locked", std::nullopt, inputs.locks.front().reason};
  }
  // A manual controller that falls silent while it drives keeps the floor: the planner must not set off by surprise.
  if (inputs.manual && inputs.manual->active) {
    return wish_of("manual", inputs.manual, tick_ns);
  }
  return wish_of("planner", inputs.planner, tick_ns);
}

DriveControl::Wish DriveControl::wish_of(const std::string& source, const std::optional<SourceCommand>& command,
                                         std::int64_t tick_ns) const {
  const std::string who = source == "manual" ? "manual controller" : "motion planner";
  if (!command) {
    return {"none", std::nullopt, "Waiting for the " + who + "."};
  }
  if (!is_fresh(command->stamp_ns, tick_ns, parameters_.command_timeout_s)) {
    return {"none", std::nullopt, "The " + who + " is silent."};
  }
  if (!command->active) {
    return {"none", Velocity{}, ""};
  }
  if (!command->velocity.is_finite()) {
    return {source, std::nullopt, "The " + who + " wants a velocity that is not a finite number."};
  }
  return {source, command->velocity, ""};
}

}  // namespace mtr_drive_control
