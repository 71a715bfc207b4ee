/// @file
/// Selection of the source of motion.
// SPDX-License-Identifier: Apache-2.0
#include "mtr_drive_control/drive_control.hpp"

#include <algorithm>

#include "mtr_core/steady_time.hpp"
#include "mtr_drive_control/base_limits.hpp"
#include "problems.hpp"

namespace mtr_drive_control {
namespace {

constexpr double kRoundingS = 1e-9;
// Commands sent longer ago do not describe the wheels' motion.
constexpr double kAwayAfterPeriods = 2.0;
// A contradiction is released after this time without a motion request.
constexpr double kRestS = 1.0;
// The lock ordered by the Operator, see mtr_dispatcher's problems.
constexpr char kOrderedStop[] = "dispatcher.stopped_by_operator";

}  // namespace

DriveControl::DriveControl(const Parameters& parameters, const CollisionParameters& collision, const RobotShape& shape,
                           double period_s, const AreaParameters& area)
    : parameters_(parameters),
      period_s_(period_s),
      odometry_timeout_s_(collision.odometry_timeout_s),
      limits_(parameters),
      collision_stop_(collision, shape),
      area_guard_(area, shape.footprint),
      limiter_(limits_, period_s),
      step_s_(period_s),
      expected_step_s_(period_s),
      tilt_(parameters) {
  check(parameters);
}

Decision DriveControl::step(std::int64_t tick_ns, const Inputs& inputs) {
  time_step(tick_ns);
  collision_stop_.take(tick_ns, with_gyro(tick_ns, inputs), expected_step_s_ - period_s_);
  area_guard_.take(tick_ns, inputs.area, inputs.sensors.motion ? inputs.sensors.motion->velocity : Velocity{});
  watch_tilt(tick_ns, inputs);
  adapt_limits(tick_ns, inputs.key);
  follow_wheels(tick_ns, inputs.sensors.motion);
  const std::vector<EngagedLock> locks = locks_at(tick_ns, inputs);
  if (contradiction_ ||
      std::any_of(locks.begin(), locks.end(), [](const EngagedLock& lock) { return lock.emergency; })) {
    // A person may carry or push the robot.
    collision_stop_.forget_ground();
  }
  const Selection selection =
      locks.empty() ? wanted_at(tick_ns, inputs) : Selection{"locked", std::nullopt, locks.front().reason};
  Decision decision;
  decision.source = selection.source;
  decision.message = selection.message;
  for (const EngagedLock& lock : locks) {
    decision.engaged_locks.push_back(lock.owner);
    decision.is_unordered_lock = decision.is_unordered_lock || lock.reason.code != kOrderedStop;
  }
  decision.velocity = pursue(tick_ns, inputs, selection, decision);
  limiter_.send(decision.velocity);
  return decision;
}

Sensors DriveControl::with_gyro(std::int64_t tick_ns, const Inputs& inputs) const {
  Sensors sensors = inputs.sensors;
  if (inputs.imu && is_heard(inputs.imu->stamp_ns, tick_ns)) {
    sensors.gyro_radps = inputs.imu->yaw_rate_radps();
  }
  return sensors;
}

void DriveControl::adapt_limits(std::int64_t tick_ns, const std::optional<KeyHeight>& key) {
  const bool is_known = key && mtr_core::is_fresh(key->stamp_ns, tick_ns, parameters_.peripherals_timeout_s);
  limits_ = tilt_.limits_at(is_known ? key->height_m : parameters_.key_raised_m);
  limiter_.set_limits(limits_);
}

void DriveControl::time_step(std::int64_t tick_ns) {
  const double since_s = stepped_ns_ ? static_cast<double>(tick_ns - *stepped_ns_) * 1e-9 : period_s_;
  const double before_s = step_s_;
  step_s_ = std::clamp(since_s, period_s_, kMaxBaseTimeoutS);
  expected_step_s_ = std::min(before_s, step_s_);
  limiter_.elapse(step_s_);
}

void DriveControl::follow_wheels(std::int64_t tick_ns, const std::optional<Motion>& motion) {
  const bool was_here = stepped_ns_ && mtr_core::is_fresh(*stepped_ns_, tick_ns, kAwayAfterPeriods * period_s_);
  stepped_ns_ = tick_ns;
  if (!was_here) {
    const bool is_known = motion && is_heard(motion->stamp_ns, tick_ns);
    limiter_.begin_from(is_known ? motion->velocity : Velocity{});
    watch_ = MotionWatch();
  }
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
  const bool is_level = permits_tilt(selection, decision);
  if (!decision.message) {
    decision.message = assessment.message;
  }
  if (!selection.velocity || !is_level || assessment.zone == Zone::kBlind ||
      limiter_.leads(inputs.sensors.motion->velocity)) {
    return limiter_.braked();
  }
  const Velocity inside = keep_in_area({assessment.velocity, wanted.by_hand}, decision);
  const DesiredMotion next{limiter_.toward(inside), wanted.by_hand};
  const Deceleration emergency{limits_.emergency_deceleration_mps2(next.velocity),
                               limits_.emergency_angular_deceleration_radps2};
  const bool is_safe = is_in_time(next.velocity, oldest_word_s(tick_ns, inputs, selection.source)) &&
                       collision_stop_.permits(next, emergency) && area_guard_.permits(next, stop_path(emergency));
  return is_safe ? next.velocity : limiter_.braked();
}

Velocity DriveControl::keep_in_area(const DesiredMotion& desired, Decision& decision) const {
  const AreaAssessment assessment = area_guard_.assess(desired, stop_path(normal_deceleration()));
  decision.zone = std::max(decision.zone, assessment.zone);
  if (!decision.message) {
    decision.message = assessment.message;
  }
  return assessment.velocity;
}

StopPath DriveControl::stop_path(const Deceleration& deceleration) const {
  return [this, deceleration](const Velocity& velocity) {
    return collision_stop_.stopping_path_of(velocity, deceleration);
  };
}

bool DriveControl::permits_tilt(const Selection& selection, Decision& decision) const {
  const mtr_core::Problem problem = tilt_.problem(limits_, selection.source == "manual");
  const mtr_core::Problem told = problem ? problem : tilt_.warning();
  const Zone zone = !problem ? Zone::kSlowed : tilt_.is_known() ? Zone::kBlocked : Zone::kBlind;
  // Blindness keeps its own message, and so does an obstacle while the tilt is only a warning.
  if (told && decision.zone != Zone::kBlind && (problem || decision.zone < Zone::kBlocked)) {
    decision.zone = zone;
    decision.hindrance.reset();
    decision.message = decision.message ? decision.message : told;
  }
  return !problem;
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

bool DriveControl::is_heard(std::int64_t stamp_ns, std::int64_t tick_ns) const {
  return mtr_core::is_fresh(stamp_ns, tick_ns, odometry_timeout_s_);
}

bool DriveControl::is_in_time(const Velocity& velocity, double oldest_word_s) const {
  return oldest_word_s + expected_step_s_ + limits_.stop_time_s(velocity) <= kStandstillWithinS + kRoundingS;
}

std::vector<PathPoint> DriveControl::stopping_path_of(const Velocity& velocity) const {
  return collision_stop_.stopping_path_of(velocity, normal_deceleration());
}

Deceleration DriveControl::normal_deceleration() const {
  return {limits_.linear_deceleration_mps2, limits_.angular_acceleration_radps2};
}

std::vector<EngagedLock> DriveControl::locks_at(std::int64_t tick_ns, const Inputs& inputs) {
  std::vector<EngagedLock> locks = inputs.locks;
  const mtr_core::Problem contradiction = contradiction_at(tick_ns, inputs);
  const std::optional<Velocity> wanted = wanted_at(tick_ns, inputs).velocity;
  if (contradiction && !contradiction_) {
    contradiction_ = contradiction;
  } else if (rest_.lasts(!contradiction && (!wanted || wanted->is_zero()), tick_ns, kRestS)) {
    contradiction_ = {};
  }
  if (contradiction_) {
    locks.push_back({kOwner, contradiction_});
  }
  if (inputs.imu && !is_heard(inputs.imu->stamp_ns, tick_ns)) {
    locks.push_back({kOwner, problems::kImuSilent()});
  }
  return locks;
}

mtr_core::Problem DriveControl::contradiction_at(std::int64_t tick_ns, const Inputs& inputs) {
  const std::optional<Motion>& motion = inputs.sensors.motion;
  const bool has_motion = motion && is_heard(motion->stamp_ns, tick_ns);
  const bool has_imu = inputs.imu && is_heard(inputs.imu->stamp_ns, tick_ns);
  return watch_.take(tick_ns, limiter_.sent(), has_motion ? motion : std::nullopt, has_imu ? inputs.imu : std::nullopt);
}

void DriveControl::watch_tilt(std::int64_t tick_ns, const Inputs& inputs) {
  const std::optional<Motion>& motion = inputs.sensors.motion;
  const bool has_motion = motion && is_heard(motion->stamp_ns, tick_ns);
  const bool has_imu = inputs.imu && is_heard(inputs.imu->stamp_ns, tick_ns);
  tilt_.take(tick_ns, has_imu ? inputs.imu : std::nullopt,
             has_motion ? std::optional<Velocity>(motion->velocity) : std::nullopt);
}

DriveControl::Selection DriveControl::wanted_at(std::int64_t tick_ns, const Inputs& inputs) const {
  // A manual controller that becomes silent while it drives keeps control: the planner must not start unexpectedly.
  if (inputs.manual && inputs.manual->active) {
    return selection_of("manual", inputs.manual, tick_ns);
  }
  return limited(selection_of("planner", inputs.planner, tick_ns), inputs.speed_limit, tick_ns);
}

DriveControl::Selection DriveControl::limited(Selection selection, const std::optional<SpeedLimit>& limit,
                                              std::int64_t tick_ns) const {
  if (!limit || !selection.velocity || selection.velocity->is_zero()) {
    return selection;
  }
  const char* who = "state machine";
  if (limit->stamp_ns == mtr_core::kNeverNs) {
    return {"none", std::nullopt, problems::kWaitingForSource({{"source", who}})};
  }
  if (!mtr_core::is_fresh(limit->stamp_ns, tick_ns, parameters_.lock_timeout_s)) {
    return {"none", std::nullopt, problems::kSourceSilent({{"source", who}})};
  }
  // NaN permits no motion; the planner reports it.
  const double max_mps = limit->max_mps > 0.0 ? limit->max_mps : 0.0;
  const double wanted_mps = std::abs(selection.velocity->linear_mps);
  const double share = max_mps == 0.0 ? 0.0 : std::min(1.0, max_mps / std::max(wanted_mps, max_mps));
  selection.velocity = selection.velocity->scaled(share);
  return selection;
}

DriveControl::Selection DriveControl::selection_of(const std::string& source,
                                                   const std::optional<SourceCommand>& command,
                                                   std::int64_t tick_ns) const {
  const std::string who = source == "manual" ? "manual controller" : "motion planner";
  if (!command) {
    return {"none", std::nullopt, problems::kWaitingForSource({{"source", who}})};
  }
  if (!mtr_core::is_fresh(command->stamp_ns, tick_ns, parameters_.command_timeout_s)) {
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
