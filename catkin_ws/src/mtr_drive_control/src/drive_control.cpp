/// @file
/// Choice of the source of motion.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/drive_control.hpp"

#include "problems.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kRoundingS = 1e-9;

}  // namespace

DriveControl::DriveControl(const Parameters& parameters, const CollisionParameters& collision, const RobotShape& shape,
                           double period_s)
    : parameters_(parameters),
      period_s_(period_s),
      limits_(parameters),
      collision_stop_(collision, shape),
      limiter_(limits_, period_s) {
  check(parameters);
}

Decision DriveControl::step(std::int64_t tick_ns, const Inputs& inputs) {
  collision_stop_.take(tick_ns, inputs.sensors);
  adapt_limits(tick_ns, inputs.key);
  const Selection selection = choose(tick_ns, inputs);
  Decision decision;
  decision.source = selection.source;
  decision.message = selection.message;
  for (const EngagedLock& lock : inputs.locks) {
    decision.engaged_locks.push_back(lock.owner);
  }
  decision.velocity = pursue(tick_ns, inputs, selection, decision);
  limiter_.send(decision.velocity);
  return decision;
}

void DriveControl::adapt_limits(std::int64_t tick_ns, const std::optional<KeyHeight>& key) {
  const bool is_known = key && is_fresh(key->stamp_ns, tick_ns, parameters_.peripherals_timeout_s);
  limits_ = limits_at(parameters_, is_known ? key->height_m : parameters_.key_raised_m);
  limiter_.set_limits(limits_);
}

Velocity DriveControl::pursue(std::int64_t tick_ns, const Inputs& inputs, const Selection& selection,
                              Decision& decision) {
  if (!selection.velocity || selection.source == "none") {
    collision_stop_.rest();
  }
  const DesiredMotion wanted{limiter_.within_limits(selection.velocity.value_or(Velocity{})),
                             selection.source == "manual"};
  const Assessment assessment = collision_stop_.assess(tick_ns, wanted, normal_deceleration());
  decision.zone = assessment.zone;
  decision.hindrance = assessment.hindrance;
  if (!decision.message) {
    decision.message = assessment.message;
  }
  if (!selection.velocity || assessment.zone == Zone::kBlind) {
    return limiter_.braked();
  }
  const DesiredMotion next{limiter_.toward(assessment.velocity), wanted.by_hand};
  const Deceleration emergency{limits_.emergency_deceleration_mps2(next.velocity),
                               limits_.emergency_angular_deceleration_radps2};
  const bool is_safe = is_in_time(next.velocity, oldest_word_s(tick_ns, inputs, selection.source)) &&
                       collision_stop_.permits(next, emergency);
  return is_safe ? next.velocity : limiter_.braked();
}

double DriveControl::oldest_word_s(std::int64_t tick_ns, const Inputs& inputs, const std::string& source) const {
  std::int64_t oldest_ns = inputs.sensors.motion->stamp_ns;
  for (const auto& sweep : {inputs.sensors.front, inputs.sensors.rear}) {
    oldest_ns = sweep ? std::min(oldest_ns, sweep->stamp_ns) : oldest_ns;
  }
  const std::optional<SourceCommand>& command = source == "manual" ? inputs.manual : inputs.planner;
  oldest_ns = command ? std::min(oldest_ns, command->stamp_ns) : oldest_ns;
  return std::max(inputs.locks_age_s, static_cast<double>(tick_ns - oldest_ns) * 1e-9);
}

bool DriveControl::is_in_time(const Velocity& velocity, double oldest_word_s) const {
  return oldest_word_s + period_s_ + limits_.stop_time_s(velocity) <= kStandstillWithinS + kRoundingS;
}

std::vector<PathPoint> DriveControl::stopping_path_of(const Velocity& velocity) const {
  return collision_stop_.stopping_path_of(velocity, normal_deceleration());
}

Deceleration DriveControl::normal_deceleration() const {
  return {limits_.linear_deceleration_mps2, limits_.angular_acceleration_radps2};
}

DriveControl::Selection DriveControl::choose(std::int64_t tick_ns, const Inputs& inputs) const {
  if (!inputs.locks.empty()) {
    return {"locked", std::nullopt, inputs.locks.front().reason};
  }
  // A manual controller that falls silent while it drives keeps the floor: the planner must not set off by surprise.
  if (inputs.manual && inputs.manual->active) {
    return selection_of("manual", inputs.manual, tick_ns);
  }
  return selection_of("planner", inputs.planner, tick_ns);
}

DriveControl::Selection DriveControl::selection_of(const std::string& source,
                                                   const std::optional<SourceCommand>& command,
                                                   std::int64_t tick_ns) const {
  const std::string who = source == "manual" ? "manual controller" : "motion planner";
  if (!command) {
    return {"none", std::nullopt, problems::kWaitingForSource({{"source", who}})};
  }
  if (!is_fresh(command->stamp_ns, tick_ns, parameters_.command_timeout_s)) {
    return {"none", std::nullopt, problems::kSourceSilent({{"source", who}})};
  }
  if (!command->active) {
    return {"none", Velocity{}, {}};
  }
  if (!command->velocity.is_finite()) {
    return {source, std::nullopt, problems::kSourceNotFinite({{"source", who}})};
  }
  return {source, command->velocity, {}};
}

}  // namespace mtr_drive_control
